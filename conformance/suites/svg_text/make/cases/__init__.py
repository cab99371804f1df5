"""A file a part of SVG 2 chapter 11."""
from . import (anchor, baseline, bidi, decoration, font, font_face, length, paint, path, position, spacing, structure,  # noqa
               variants, vertical, whitespace)
