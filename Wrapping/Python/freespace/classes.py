# SPDX-License-Identifier: BSD-3-Clause
"""The wrapped VTK classes with keyword arguments, properties and paths.

    surface = vtkBisectionContourFilter(cells=512, sharp_edges=True)
    surface.cells                               # GetCells()
    vtkSurfaceWriter(file_name=Path('mesh.ply'))

As VTK 9.4 has them: property x_y_z stands for SetXYZ and GetXYZ. Where a method takes a string, it takes a
pathlib.Path, too. While Update and Write work other Python threads go on, Ctrl-C stops them, and exceptions of observers
are raised. An object that comes from a pipeline, not from here, has the methods alone.
"""
import inspect
import os
import re
from functools import partial

from . import vtkFreespaceFilters, vtkFreespaceReaders, vtkFreespaceRendering, vtkFreespaceSurface, vtkFreespaceWriters
from .running import Run, run_method

MODULES = (vtkFreespaceFilters, vtkFreespaceSurface, vtkFreespaceReaders, vtkFreespaceWriters, vtkFreespaceRendering)


def snake_case(name):
    """NumberOfViews -> number_of_views, GLBFile -> glb_file."""
    return re.sub(r'(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])', '_', name).lower()


def _is_wrapped(value, module):
    return isinstance(value, type) and value.__name__.startswith('vtk') and value.__name__ in vars(module)


def _setters(base):
    """The Set methods that have a Get method, of the class and not of VTK's that it is made from."""
    vtk = next(each for each in base.__mro__ if not any(_is_wrapped(each, module) for module in MODULES))
    return {snake_case(name[3:]): name for name in dir(base)
            if re.match(r'Set[A-Z]', name) and hasattr(base, 'Get' + name[3:]) and not hasattr(vtk, name)}


def _property(base, setter):
    getter = 'Get' + setter[3:]
    return property(lambda self: getattr(self, getter)(), lambda self, value: getattr(self, setter)(value),
                    doc=inspect.getdoc(getattr(base, setter)))


def _taking_paths(method):
    def call(self, *arguments):
        if arguments == (None,): # no name, as a null pointer is in C++
            arguments = ('',)
        return method(self, *(os.fspath(a) if isinstance(a, os.PathLike) else a for a in arguments))
    call.__name__, call.__doc__ = method.__name__, method.__doc__
    return call


def _running(base, name):
    def call(self, *arguments):
        with Run(self):
            return run_method(self, name, *arguments, otherwise=partial(getattr(base, name), self))
    call.__name__, call.__doc__ = name, getattr(base, name).__doc__
    return call


def _new(cls, *arguments, **properties):
    return super(cls.__freespace__, cls).__new__(cls, *arguments)


def _init(self, *arguments, **properties):
    for name, value in properties.items():
        if name not in self.__properties__:
            raise TypeError(f'{type(self).__name__} has no property {name!r}; it has '
                            + ', '.join(sorted(self.__properties__)))
        setattr(self, name, value)


def _with_properties(base):
    setters = _setters(base)
    members = {name: _property(base, setter) for name, setter in setters.items() if not hasattr(base, name)}
    for name in dir(base):
        method = getattr(base, name)
        if inspect.ismethoddescriptor(method) and re.search(r'\(.*\bstr\b.*\) ->', method.__doc__ or '') \
                and re.match(r'Set|Add|Write', name) and name != 'AddObserver':
            members[name] = _taking_paths(method)
    members.update({name: _running(base, name) for name in ('Update', 'Write') if hasattr(base, name)})
    members.update(__doc__=base.__doc__, __module__='freespace', __properties__=frozenset(setters),
                   __new__=_new, __init__=_init)
    made = type(base.__name__, (base,), members)
    made.__freespace__ = made
    return made


__all__ = []
for _module in MODULES:
    for _name, _class in sorted(vars(_module).items()):
        if _is_wrapped(_class, _module):
            globals()[_name] = _with_properties(_class)
            __all__.append(_name)
