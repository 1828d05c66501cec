"""What may be imported in a worker besides Python's own library, and where it is found.

It needs Python's own library alone, and is seen in the sandbox beside worker.py.
"""
import importlib.abc
import importlib.util
import os
import types


class Packages:
    """Finds numpy and scipy in one folder, and nothing else there."""

    def __init__(self, folder):
        self.folder = folder

    def find_spec(self, name, path=None, target=None):
        if name in ("numpy", "scipy"):
            folder = os.path.join(self.folder, name)
            return importlib.util.spec_from_file_location(
                name, os.path.join(folder, "__init__.py"), submodule_search_locations=[folder])


class Given(importlib.abc.MetaPathFinder, importlib.abc.ExecutionLoader):
    """Finds the modules that labs may import, of the course and of the student's own: {name: text}.
    """

    def __init__(self, texts):
        self.texts = texts

    def find_spec(self, name, path=None, target=None):
        if name in self.texts:
            return importlib.util.spec_from_loader(name, self, is_package=not self.texts[name])

    def get_source(self, name):
        return self.texts[name]

    def get_filename(self, name):
        return f"{name.replace('.', '/')}.py"


class Drawing(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds matplotlib, whatever of it is imported, as a module that draws nothing."""

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("matplotlib", "mpl_toolkits"):
            return importlib.util.spec_from_loader(name, self, is_package=True)

    def create_module(self, spec):
        return Nothing(spec.name)

    def exec_module(self, module):
        pass


class Nothing(types.ModuleType):
    """A module whose names, items and calls are itself, and which can be unpacked as a pair."""

    def __getattr__(self, name):
        if name.startswith("__"):  # Python's own questions, such as for __array__
            raise AttributeError(name)
        return self

    def __call__(self, *_, **__):
        return self

    __getitem__ = __setitem__ = __enter__ = __call__

    def __exit__(self, *_):
        """An error in a with statement stays one."""

    def __iter__(self):
        return iter((self, self))  # figure, axes = plt.subplots()
