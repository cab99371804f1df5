"""Loads SVG, .vtmtree or compiled .vtm files and renders them to NumPy arrays.

    import vtm
    picture = vtm.Picture.load("tiger.svg")
    picture.render(width=800).save("tiger.png")
    array = picture.render(width=64, view=(100, 100, 20, 20)).array   # (height, width, 4), uint8

It calls <vtm/vtm.h> through ctypes; the comments there say more.
"""
import ctypes
import os
import pathlib

import numpy

__all__ = ["Error", "Image", "Picture", "version"]


class Error(Exception):
    """A failure of the library; the message names the place and the cause."""


class _RenderOptions(ctypes.Structure):
    _fields_ = [
        ("width", ctypes.c_int), ("height", ctypes.c_int), ("scale", ctypes.c_double), ("fit", ctypes.c_int),
        ("view", ctypes.c_double * 4), ("rotation", ctypes.c_double), ("matrix", ctypes.c_double * 6),
        ("background", ctypes.c_float * 4), ("engine", ctypes.c_int),
    ]


_FAMILIES = ("serif", "sans-serif", "cursive", "fantasy", "monospace", "default")


class _LoadOptions(ctypes.Structure):
    _fields_ = [
        ("name", ctypes.c_char_p), ("folder", ctypes.c_char_p), ("dpi", ctypes.c_double),
        ("language", ctypes.c_char_p), ("font_directories", ctypes.POINTER(ctypes.c_char_p)),
        ("no_system_fonts", ctypes.c_int), *((name, ctypes.c_char_p) for name in _FAMILIES),
        ("default_font_size", ctypes.c_double),
    ]


_FITS = ("contain", "cover", "stretch")
_ENGINES = ("auto", "cpu", "gl")
_FUNCTIONS = {  # results and arguments
    "vtmVersion": (ctypes.c_char_p, ()),
    "vtmGetError": (ctypes.c_char_p, ()),
    "vtmLoadPictureWithOptions": (ctypes.c_void_p, (ctypes.c_char_p, ctypes.POINTER(_LoadOptions))),
    "vtmLoadPictureFromMemoryWithOptions": (ctypes.c_void_p, (ctypes.c_char_p, ctypes.c_size_t,
                                                              ctypes.POINTER(_LoadOptions))),
    "vtmDestroyPicture": (None, (ctypes.c_void_p,)),
    "vtmPictureWidth": (ctypes.c_double, (ctypes.c_void_p,)),
    "vtmPictureHeight": (ctypes.c_double, (ctypes.c_void_p,)),
    "vtmPictureWarningCount": (ctypes.c_size_t, (ctypes.c_void_p,)),
    "vtmGetPictureWarning": (ctypes.c_size_t, (ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)),
    "vtmSavePicture": (ctypes.c_int, (ctypes.c_void_p, ctypes.c_char_p)),
    "vtmRenderPicture": (ctypes.c_void_p, (ctypes.c_void_p, ctypes.POINTER(_RenderOptions))),
    "vtmDestroyImage": (None, (ctypes.c_void_p,)),
    "vtmImageWidth": (ctypes.c_int, (ctypes.c_void_p,)),
    "vtmImageHeight": (ctypes.c_int, (ctypes.c_void_p,)),
    "vtmImageEngine": (ctypes.c_int, (ctypes.c_void_p,)),
    "vtmImagePixels": (ctypes.c_void_p, (ctypes.c_void_p,)),
    "vtmSaveImage": (ctypes.c_int, (ctypes.c_void_p, ctypes.c_char_p)),
}


def _open():
    """Returns the library installed with this module, otherwise the one that the loader finds."""
    name = "libvtm.so.0"
    beside = pathlib.Path(__file__).resolve().parents[3] / name  # LIB/python3/dist-packages/vtm
    library = ctypes.CDLL(str(beside) if beside.exists() else name)
    for function, (result, arguments) in _FUNCTIONS.items():
        getattr(library, function).restype = result
        getattr(library, function).argtypes = arguments
    return library


_library = _open()


def _checked(result):
    if not result:
        raise Error(_library.vtmGetError().decode(errors="replace"))
    return result


def _choice(names, name, what):
    if name not in names:
        raise ValueError(f"{what}: {name!r} is not one of {', '.join(names)}")
    return names.index(name)


def version():
    """Returns the version, for example "0.2.0"."""
    return _library.vtmVersion().decode()


class Image:
    """A rendered image, made by Picture.render."""

    def __init__(self, handle):
        self._handle = handle

    def __del__(self):
        _library.vtmDestroyImage(self._handle)

    @property
    def engine(self):
        """The engine that drew it: "cpu" or "gl"."""
        return _ENGINES[_library.vtmImageEngine(self._handle)]

    @property
    def array(self):
        """A copy: (height, width, 4) bytes of straight sRGB with alpha, rows from the top."""
        height, width = _library.vtmImageHeight(self._handle), _library.vtmImageWidth(self._handle)
        pixels = (ctypes.c_uint8 * (height * width * 4)).from_address(_library.vtmImagePixels(self._handle))
        return numpy.frombuffer(pixels, numpy.uint8).reshape(height, width, 4).copy()

    def save(self, path):
        """Writes a file in the format of its suffix: .png, .jpg, .webp or .ppm."""
        _checked(_library.vtmSaveImage(self._handle, os.fsencode(path)))


class Picture:
    """An SVG file, a .vtmtree file or a compiled .vtm file. Made by load; may be used from several threads at once."""

    def __init__(self, handle):
        self._handle = handle

    def __del__(self):
        _library.vtmDestroyPicture(self._handle)

    @classmethod
    def load(cls, source, name=None, *, folder=None, dpi=96, language="en", font_directories=(), system_fonts=True,
             families=None, default_font_size=12):
        """Loads a file: a path, or the bytes of a file, which messages call `name`. Raises Error. folder: to which
        relative references refer; the file's own by default, for bytes none. dpi: pixels per inch. language: of text,
        and for systemLanguage. font_directories are searched before the system's fonts. families: which family "serif",
        "sans-serif", "cursive", "fantasy" or "monospace" stands for, and the "default" where none is named.
        default_font_size: of text without a size, user units."""
        named = {_FAMILIES[_choice(_FAMILIES, family, "families")]: os.fsencode(value)
                 for family, value in (families or {}).items()}
        for what, given in {"dpi": dpi, "default_font_size": default_font_size}.items():
            if not given:  # which would mean the default to the library
                raise ValueError(f"{what} is zero")
        directories = [os.fsencode(directory) for directory in font_directories]
        options = _LoadOptions(os.fsencode(name or ""), os.fsencode(folder) if folder else None, dpi, language.encode(),
                               (ctypes.c_char_p * (len(directories) + 1))(*directories), not system_fonts,
                               default_font_size=default_font_size, **named)
        if isinstance(source, (bytes, bytearray, memoryview)):
            data = bytes(source)
            handle = _library.vtmLoadPictureFromMemoryWithOptions(data, len(data), ctypes.byref(options))
        else:
            handle = _library.vtmLoadPictureWithOptions(os.fsencode(source), ctypes.byref(options))
        return cls(_checked(handle))

    @property
    def width(self):
        """In user units."""
        return _library.vtmPictureWidth(self._handle)

    @property
    def height(self):
        """In user units."""
        return _library.vtmPictureHeight(self._handle)

    @property
    def warnings(self):
        """A list of strings: what was left out or repaired so far."""
        return [self._warning(i) for i in range(_library.vtmPictureWarningCount(self._handle))]

    def _warning(self, index):
        size = _library.vtmGetPictureWarning(self._handle, index, None, 0) + 1
        text = ctypes.create_string_buffer(size)
        _library.vtmGetPictureWarning(self._handle, index, text, size)
        return text.value.decode(errors="replace")

    def render(self, *, width=0, height=0, scale=1, fit="contain", view=None, rotation=0, matrix=None,
               background=(0, 0, 0, 0), engine="auto"):
        """Returns an Image; raises Error. width, height: pixels; with one of them the aspect ratio is kept, with both
        `fit` applies ("contain", "cover", "stretch"), with neither `scale`, in pixels per user unit. view: (x, y, width,
        height) of the visible part, user units. rotation: degrees, clockwise. matrix: replaces scale, fit, view and
        rotation, (a, b, c, d, e, f) as in SVG. background: straight sRGB and alpha in [0, 1]. engine: "auto", "cpu",
        "gl"."""
        for what, given in {"scale": (scale,), "view": view, "matrix": matrix}.items():
            if given is not None and not any(given):  # which would mean none to the library
                raise ValueError(f"{what} is zero")
        options = _RenderOptions(width, height, scale, _choice(_FITS, fit, "fit"), tuple(view or (0,) * 4), rotation,
                                 tuple(matrix or (0,) * 6), tuple(background), _choice(_ENGINES, engine, "engine"))
        return Image(_checked(_library.vtmRenderPicture(self._handle, ctypes.byref(options))))

    def save(self, path):
        """Compiles the picture and writes it to a .vtm file. Raises Error."""
        _checked(_library.vtmSavePicture(self._handle, os.fsencode(path)))
