# SPDX-License-Identifier: BSD-3-Clause
"""VTK tells of errors by events; Python by exceptions."""
import re

from vtkmodules.vtkCommonCore import vtkCommand

from . import _unlocked
from .running import Run, run_method


class Error(RuntimeError):
    """What a VTK algorithm reported as an error."""


def _sentence(text):
    """A VTK error without the place in the source and the object's address."""
    lines = [line.strip() for line in text.strip().splitlines()]
    lines = [line for line in lines if line and not line.startswith('ERROR: In ')]
    return re.sub(r'^\w+ \(0x[0-9a-f]+\): ', '', ' '.join(lines)) or text.strip()


class ErrorsRaised(Run):
    """A call whose first error, of an algorithm or one that it takes its input from, is raised at its end."""

    def __enter__(self):
        self.errors = []

        def note(caller, event, text):
            self.errors.append(_sentence(text or ''))
        note.CallDataType = 'string0'
        self.tags += [(it, it.AddObserver(vtkCommand.ErrorEvent, note)) for it in self.watched]
        return super().__enter__()

    def __exit__(self, *exception):
        super().__exit__(*exception)
        if self.errors and exception[0] is None:
            raise Error(self.errors[0])


def check_valid(phi):
    """Raises Error where the maps of a union are not valid and this was told before."""
    if not phi.GetAbortExecute() and not phi.IsValid():
        raise Error('The disparity maps are not valid.')


def update(algorithm, port=0):
    """Updates an algorithm, or writes where it is a writer, and returns its output. A vtkFreespaceUnion is built,
    and returned itself.

    Raises freespace.Error with the first error that the algorithm, or one that it takes its input from,
    reports. Without this, VTK prints the error and goes on with an empty output. Raises what an observer raises,
    and KeyboardInterrupt at once where Ctrl-C is pressed. Other Python threads go on meanwhile.
    """
    with ErrorsRaised(algorithm) as run:
        for phi in _unions_of_others(run.watched):
            _unlocked.update(phi, 0)
            if run.reason is not None or run.errors:
                return None # and raise
        done = run_method(algorithm, 'Write') if hasattr(algorithm, 'Write') else run_method(algorithm, 'Update', port)
    if done == 0:
        raise Error(f'{algorithm.GetClassName()} could not write.')
    if algorithm.IsA('vtkFreespaceUnion'):
        check_valid(algorithm)
        return algorithm
    if not hasattr(algorithm, 'GetNumberOfOutputPorts'):
        return algorithm
    return algorithm.GetOutputDataObject(port) if algorithm.GetNumberOfOutputPorts() else None


def _unions_of_others(watched):
    """The unions that VTK's cutters and clippers evaluate, which would not stop while they are built."""
    contoured = [it.GetImplicitFunction() for it in watched if it.IsA('vtkBisectionContourFilter')]
    return [it for it in watched[1:] if it.IsA('vtkFreespaceUnion') and it not in contoured]
