# SPDX-License-Identifier: BSD-3-Clause
"""VTK tells of errors by events; Python by exceptions."""
import re

from vtkmodules.vtkCommonCore import vtkCollection, vtkCommand


class Error(RuntimeError):
    """What a VTK algorithm reported as an error."""


# Where algorithms and functions have further ones: contours, cutters, clippers, booleans, unions.
FUNCTIONS = ('GetImplicitFunction', 'GetCutFunction', 'GetClipFunction', 'GetFunction', 'GetExecutive')


def _members(other):
    """The functions of a collection, the producer of a connection, or the object itself."""
    if isinstance(other, vtkCollection):
        return [other.GetItemAsObject(i) for i in range(other.GetNumberOfItems())]
    if hasattr(other, 'GetProducer'):
        return [other.GetProducer()]
    return [other] if hasattr(other, 'AddObserver') else []


def _upstream(algorithm):
    """The algorithm and all that it takes its input from, with implicit functions and executives."""
    found, waiting = [], [algorithm]
    while waiting:
        it = waiting.pop()
        if it is None or it in found:
            continue
        found.append(it)
        for getter in FUNCTIONS:
            if hasattr(it, getter):
                waiting += _members(getattr(it, getter)())
        if it.IsA('vtkFreespaceUnion'):
            waiting += _members(it.GetInputConnection())
        if hasattr(it, 'GetTotalNumberOfInputConnections'):
            for port in range(it.GetNumberOfInputPorts()):
                for i in range(it.GetNumberOfInputConnections(port)):
                    waiting.append(it.GetInputConnection(port, i).GetProducer())
    return found


def _sentence(text):
    """A VTK error without the place in the source and the object's address."""
    lines = [line.strip() for line in text.strip().splitlines()]
    lines = [line for line in lines if line and not line.startswith('ERROR: In ')]
    return re.sub(r'^\w+ \(0x[0-9a-f]+\): ', '', ' '.join(lines)) or text.strip()


def update(algorithm, port=0):
    """Updates an algorithm, or writes where it is a writer, and returns its output. A vtkFreespaceUnion is built,
    and returned itself.

    Raises freespace.Error with the first error that the algorithm, or one that it takes its input from,
    reports. Without this, VTK prints the error and goes on with an empty output.
    """
    errors = []

    def note(caller, event, text):
        errors.append(_sentence(text or ''))
    note.CallDataType = 'string0'
    watched = [(it, it.AddObserver(vtkCommand.ErrorEvent, note)) for it in _upstream(algorithm)]
    try:
        isWriter = hasattr(algorithm, 'Write')
        done = algorithm.Write() if isWriter else algorithm.Update()
    finally:
        for it, tag in watched:
            it.RemoveObserver(tag)
    if errors or (isWriter and done == 0):
        raise Error(errors[0] if errors else f'{algorithm.GetClassName()} could not write.')
    if not hasattr(algorithm, 'GetNumberOfOutputPorts'):
        return algorithm
    return algorithm.GetOutputDataObject(port) if algorithm.GetNumberOfOutputPorts() else None
