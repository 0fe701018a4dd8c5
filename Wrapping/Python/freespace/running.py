# SPDX-License-Identifier: BSD-3-Clause
"""Calls of VTK that take long: other Python threads go on, Ctrl-C stops them, and exceptions of observers are raised.

VTK by itself keeps Python's lock while a filter works, hears of Ctrl-C when all is done, and prints what an observer
raises. Here the call is made without the lock; at each ProgressEvent, Python looks whether there is a reason to stop.
"""
import signal
import sys
import threading

from vtkmodules.vtkCommonCore import vtkCollection, vtkCommand

from . import _unlocked

# Where algorithms and functions have further ones: contours, cutters, clippers, booleans, unions.
FUNCTIONS = ('GetImplicitFunction', 'GetCutFunction', 'GetClipFunction', 'GetFunction', 'GetExecutive')


class Interrupted(RuntimeError):
    """Ctrl-C stopped a call that an observer of another one makes. That one raises KeyboardInterrupt: raised in
    an observer, it would make VTK end the process."""


def _members(other):
    """The functions of a collection, the producer of a connection, or the object itself."""
    if isinstance(other, vtkCollection):
        return [other.GetItemAsObject(i) for i in range(other.GetNumberOfItems())]
    if hasattr(other, 'GetProducer'):
        return [other.GetProducer()]
    return [other] if hasattr(other, 'AddObserver') else []


def upstream(algorithm):
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


class Run:
    """One call. What makes it stop is raised at its end: `with Run(algorithm): ...`"""

    _running = threading.local()
    _lock = threading.Lock()
    _hooked = 0 # runs, of all threads, during which sys.excepthook is ours
    _hook_before = None

    def __init__(self, algorithm):
        self.watched = upstream(algorithm)
        self.reason = None
        self.tags = []
        self.handler = None

    def __enter__(self):
        self.outer = getattr(Run._running, 'top', None)
        Run._running.top = self
        for it in self.watched:
            self.tags.append((it, it.AddObserver(vtkCommand.ProgressEvent, self._look, 1e9)))
        self._hook_exceptions()
        self._hear_of_interrupts()
        return self

    def __exit__(self, *exception):
        if self.handler is not None:
            signal.signal(signal.SIGINT, self.handler)
        self._unhook_exceptions()
        for it, tag in self.tags:
            it.RemoveObserver(tag)
        Run._running.top = self.outer
        if self.reason is None or exception[0] is not None:
            return
        for it in self.watched: # their outputs are not what they should be
            if hasattr(it, 'GetAbortExecute') and it.GetAbortExecute():
                it.SetAbortExecute(0) # VTK 9.3 does not
                it.Modified()
        if self.outer is not None and not isinstance(self.reason, Exception):
            self.outer.stop(self.reason)
            raise Interrupted('The call was interrupted.')
        raise self.reason

    def stop(self, reason):
        """Makes the call end at the next ProgressEvent, and raise this. Ctrl-C takes precedence."""
        if self.reason is None or not isinstance(reason, Exception):
            self.reason = reason

    def _look(self, caller, event):
        if self.reason is not None:
            self._ignore_errors()
            if hasattr(caller, 'SetAbortExecute'):
                caller.SetAbortExecute(1)

    def _ignore_errors(self):
        """What is downstream finds no input: this is no error to be told."""
        if not getattr(self, 'ignoring', False):
            self.ignoring = True
            self.tags += [(it, it.AddObserver(vtkCommand.ErrorEvent, lambda *_: None)) for it in self.watched]

    def _hear_of_interrupts(self):
        """Only the main thread can. The handler that is there is called at once, but what it raises comes at the
        end: raised in an observer, a KeyboardInterrupt makes VTK end the process."""
        if threading.current_thread() is not threading.main_thread() or not callable(signal.getsignal(signal.SIGINT)):
            return
        handler = signal.getsignal(signal.SIGINT)

        def hear(number, frame):
            try:
                handler(number, frame)
            except BaseException as reason:
                self.stop(reason)
        self.handler = handler
        signal.signal(signal.SIGINT, hear)

    @classmethod
    def _hook_exceptions(cls):
        """VTK gives what an observer raises to sys.excepthook."""
        with cls._lock:
            if cls._hooked == 0:
                cls._hook_before = sys.excepthook
                sys.excepthook = cls._take_exception
            cls._hooked += 1

    @classmethod
    def _unhook_exceptions(cls):
        with cls._lock:
            cls._hooked -= 1
            if cls._hooked == 0 and sys.excepthook == cls._take_exception:
                sys.excepthook = cls._hook_before

    @staticmethod
    def _take_exception(kind, value, traceback):
        run = getattr(Run._running, 'top', None)
        if run is None:
            (Run._hook_before or sys.__excepthook__)(kind, value, traceback)
        else:
            run.stop(value.with_traceback(traceback))


def run_method(algorithm, name, *arguments, otherwise=None):
    """Calls Update([port]) or Write() within a Run, without Python's lock where the class allows."""
    if name == 'Write' and algorithm.IsA('vtkWriter') and not arguments:
        return _unlocked.write(algorithm)
    if name == 'Update' and (algorithm.IsA('vtkAlgorithm') or algorithm.IsA('vtkFreespaceUnion')) \
            and [type(each) for each in arguments] in ([], [int]):
        return _unlocked.update(algorithm, *(arguments or (0,)))
    return (otherwise or getattr(algorithm, name))(*arguments)
