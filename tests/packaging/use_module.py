"""use_module.py PICTURE OUT.png: what the Python module promises."""
import sys

import numpy
import vtm

picture = vtm.Picture.load(sys.argv[1])
image = picture.render(width=80)
image.save(sys.argv[2])
array = image.array
assert array.shape[1:] == (80, 4) and array.dtype == numpy.uint8, array.shape
assert image.engine in ("cpu", "gl")
del image  # the array is a copy
assert array[..., 3].max() == 255

square = vtm.Picture.load(b'<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2">'
                          b'<rect width="2" height="2" fill="red"/><foreignObject/></svg>', name="square.svg")
assert (square.width, square.height) == (4, 2)
assert len(square.warnings) == 1 and square.warnings[0].startswith("square.svg:1:"), square.warnings
red, white = [255, 0, 0, 255], [255, 255, 255, 255]
assert square.render(background=(1, 1, 1, 1)).array[0].tolist() == [red, red, white, white]
assert square.render(rotation=180, background=(1, 1, 1, 1)).array[0].tolist() == [white, white, red, red]
assert square.render(view=(1, 0, 2, 2), background=(1, 1, 1, 1)).array[0].tolist() == [red, white]
assert square.render(width=2, height=2, matrix=(1, 0, 0, 1, -1, 0)).array[0].tolist() == [red, [0, 0, 0, 0]]

inch = b'<svg xmlns="http://www.w3.org/2000/svg" width="1in" height="1in"><text y="9">a</text></svg>'
assert vtm.Picture.load(inch, dpi=72).width == 72
lonely = vtm.Picture.load(inch, "inch.svg", font_directories=["/nowhere"], system_fonts=False,
                          families={"sans-serif": "None", "default": "None"}, language="de", default_font_size=9)
assert len(lonely.warnings) == 1 and "there are no fonts" in lonely.warnings[0], lonely.warnings

for wrong in (lambda: vtm.Picture.load("missing.svg"), lambda: vtm.Picture.load(b"<svg", name="bad.svg"),
              lambda: vtm.Picture.load(inch, dpi=-1), lambda: square.render(width=-1), lambda: square.render(width=10**6)):
    try:
        wrong()
    except vtm.Error as error:
        assert str(error)
    else:
        raise AssertionError("no error")
for wrong in (lambda: vtm.Picture.load(inch, families={"Arial": "None"}), lambda: vtm.Picture.load(inch, dpi=0),
              lambda: square.render(fit="none"), lambda: square.render(engine="vulkan"), lambda: square.render(scale=0)):
    try:
        wrong()
    except ValueError:
        pass
    else:
        raise AssertionError("no error")
