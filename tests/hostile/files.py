"""SVG files that ask for too much: of the stack, of time, of memory.

Each function makes one file's bytes; `n` scales it (1: for every test run, 10: as found in the wild).
"""
import base64
import gzip
import math
import random
import struct
import zlib

FILES = {}


def hostile(make):
    FILES[make.__name__] = make
    return make


def svg(body, head="", size=100):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{size}" '
            f'height="{size}">{head}{body}</svg>').encode()


def chain(count, link):
    return "".join(link(i) for i in range(count))


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packer = zlib.compressobj(1)
    rows = b"".join(packer.compress(b"\0" * (3 * width + 1)) for _ in range(height)) + packer.flush()
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", rows) + chunk(b"IEND", b""))


def data_url(data, kind):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


# ---- the stack ------------------------------------------------------------------------------------

@hostile
def nested_groups(n):
    return svg("<g>" * 100_000 * n + "</g>" * 100_000 * n)


@hostile
def nested_unknown_elements(n):
    return svg("<x>" * 100_000 * n)


@hostile
def chain_of_uses(n):
    return svg(chain(100_000 * n, lambda i: f'<g id="u{i}"><use href="#u{i + 1}"/></g>'))


@hostile
def chain_of_clips(n):
    links = chain(100_000 * n, lambda i: f'<clipPath id="c{i}" clip-path="url(#c{i + 1})"><path d="M0 0h9v9"/></clipPath>')
    return svg(links + '<rect width="9" height="9" clip-path="url(#c0)"/>')


@hostile
def chain_of_clipped_shapes(n):
    links = chain(100_000 * n, lambda i: f'<clipPath id="c{i}"><path d="M0 0h9v9" clip-path="url(#c{i + 1})"/></clipPath>')
    return svg(links + '<rect width="9" height="9" clip-path="url(#c0)"/>')


@hostile
def chain_of_masks(n):
    links = chain(100_000 * n, lambda i: f'<mask id="m{i}" mask="url(#m{i + 1})"><path fill="#fff" d="M0 0h9v9"/></mask>')
    return svg(links + '<rect width="9" height="9" mask="url(#m0)"/>')


@hostile
def chain_of_masked_shapes(n):
    links = chain(100_000 * n, lambda i: f'<mask id="m{i}"><path fill="#fff" mask="url(#m{i + 1})" d="M0 0h9v9"/></mask>')
    return svg(links + '<rect width="9" height="9" mask="url(#m0)"/>')


@hostile
def chain_of_patterns(n):
    links = chain(100_000 * n, lambda i: f'<pattern id="p{i}" width="1" height="1"><rect width="9" height="9" fill="url(#p{i + 1})"/></pattern>')
    return svg(links + '<rect width="9" height="9" fill="url(#p0)"/>')


@hostile
def groups_in_chained_patterns(n):
    deep, end = "<g opacity='.9'>" * 200, "</g>" * 200
    links = chain(200 * n, lambda i: f'<pattern id="p{i}" width="1" height="1">{deep}<rect width="9" height="9" fill="url(#p{i + 1})"/>{end}</pattern>')
    return svg(links + '<rect width="9" height="9" fill="url(#p0)"/>')


@hostile
def chain_of_markers(n):
    links = chain(100_000 * n, lambda i: f'<marker id="k{i}"><path d="M0 0L3 3" marker-start="url(#k{i + 1})"/></marker>')
    return svg(links + '<path stroke="red" d="M0 0L9 9" marker-start="url(#k0)"/>')


@hostile
def chain_of_gradients(n):
    links = chain(100_000 * n, lambda i: f'<linearGradient id="g{i}" href="#g{i + 1}"/>')
    return svg(links + '<rect width="9" height="9" fill="url(#g0)"/>' * 100)


@hostile
def long_selector(n):
    return svg("<g/>" * 20_000 * n, "<style>" + "*+" * 100_000 * n + "g{fill:red}</style>")


@hostile
def images_in_images(n):
    picture = svg("<g>" * 250 + '<rect width="9" height="9"/>' + "</g>" * 250)
    for _ in range(10):
        url = data_url(picture, "image/svg+xml")
        picture = svg("<g>" * 250 + f'<image width="9" height="9" href="{url}"/>' + "</g>" * 250)
    return picture


# ---- multiplication -------------------------------------------------------------------------------

@hostile
def billion_uses(n):
    levels = chain(9, lambda i: f'<g id="l{i + 1}">' + f'<use href="#l{i}"/>' * 10 + "</g>")
    return svg('<rect id="l0" width="1" height="1"/>' + levels)


@hostile
def billion_laughs(n):
    entities = '<!ENTITY a0 "<rect width=\'1\' height=\'1\'/>">' + chain(
        12, lambda i: f'<!ENTITY a{i + 1} "' + f"&a{i};" * 10 + '">')
    return b"<!DOCTYPE svg [" + entities.encode() + b"]>" + svg("&a12;")


@hostile
def quadratic_entity(n):
    return b'<!DOCTYPE svg [<!ENTITY a "' + b"x" * 100_000 + b'">]>' + svg("&a;" * 10_000 * n)


@hostile
def masks_that_double(n):
    links = chain(30, lambda i: f'<mask id="m{i}">' + f'<rect width="9" height="9" fill="#fff" mask="url(#m{i + 1})"/>' * 2 + "</mask>")
    return svg(links + '<rect width="9" height="9" mask="url(#m0)"/>')


@hostile
def clips_that_double(n):
    links = chain(30, lambda i: f'<clipPath id="c{i}">' + f'<path d="M0 0h9v9" clip-path="url(#c{i + 1})"/>' * 2 + "</clipPath>")
    return svg(links + '<rect width="9" height="9" clip-path="url(#c0)"/>')


@hostile
def patterns_that_multiply(n):
    links = chain(8, lambda i: f'<pattern id="p{i}" width=".1" height=".1"><rect width="90" height="90" fill="url(#p{i + 1})"/></pattern>')
    return svg(links + '<rect width="90" height="90" fill="url(#p0)"/>')


@hostile
def pattern_of_specks(n):
    return svg('<pattern id="p" width=".001" height=".001"><circle r=".05"/></pattern>'
               '<rect width="90" height="90" fill="url(#p)"/>')


@hostile
def pattern_of_many_shapes(n):
    shapes = chain(2000 * n, lambda i: f'<circle cx="{i % 9}" cy="{i % 7}" r="{i % 5}" opacity=".5"/>')
    return svg(f'<pattern id="p" width=".02" height=".02">{shapes}</pattern><rect width="90" height="90" fill="url(#p)"/>')


@hostile
def grid_of_symbols(n):
    return svg('<symbol id="s" viewBox="0 0 9 9"><circle r="4" opacity=".5" stroke="red"/></symbol>' + chain(
        50_000 * n, lambda i: f'<use href="#s" x="{i % 99}" y="{i // 990 % 99}" width="3" height="3"/>'))


@hostile
def markers_on_a_long_path(n):
    points = " ".join(f"{i % 101},{i * 7 % 97}" for i in range(100_000 * n))
    return svg('<marker id="k"><circle r="1"/></marker>'
               f'<polyline points="{points}" fill="none" marker-mid="url(#k)"/>')


@hostile
def context_paints(n):
    links = chain(40, lambda i: f'<g id="l{i + 1}"><use href="#l{i}" fill="url(#g)"/><use href="#l{i}" stroke="context-fill"/></g>')
    return svg('<linearGradient id="g"><stop/><stop offset="1" stop-color="red"/></linearGradient>'
               f'<rect id="l0" width="9" height="9" fill="context-fill" stroke="context-stroke"/>{links}<use href="#l40"/>')


@hostile
def gzip_bomb(n):
    return gzip.compress(svg(" " * 30_000_000 * n), 9)


# ---- strokes and outlines -------------------------------------------------------------------------

@hostile
def dashed_circle(n):
    return svg('<circle cx="50" cy="50" r="40" fill="none" stroke="#000" stroke-dasharray=".0013 .0012"/>')


@hostile
def dashed_cubic_far_away(n):
    return svg('<path d="M0 0C1e5 9e4 -9e4 1e5 100 100" fill="none" stroke="#000" stroke-dasharray="1 1"/>' * 10)


@hostile
def dashes_without_end(n):
    dashes = " ".join(["1e-9"] * 100_000 * n)
    return svg(f'<circle r="40" fill="none" stroke="#000" stroke-dasharray="{dashes}"/>')


@hostile
def round_dots(n):
    return svg('<path d="M0 50H100" fill="none" stroke="#0008" stroke-width="30" stroke-linecap="round" '
               'stroke-dasharray="0 .001"/>')


@hostile
def zigzag(n):
    points = " ".join(f"{i / 1000:.3f},{90 * (i % 2)}" for i in range(100_000))
    return svg(f'<polyline points="{points}" fill="none" stroke="#000" stroke-width=".5"/>')


@hostile
def rays(n):
    lines = chain(30_000, lambda i: f"M50 50L{50 + 50 * math.cos(i):.4f} {50 + 50 * math.sin(i):.4f}")
    return svg(f'<path d="{lines}" stroke="#000" stroke-width=".01"/>')


@hostile
def scribble(n):
    r = random.Random(1)
    curves = chain(20_000, lambda i: f"C{r.random() * 99:.2f} {r.random() * 99:.2f} {r.random() * 99:.2f} "
                                     f"{r.random() * 99:.2f} {r.random() * 99:.2f} {r.random() * 99:.2f}")
    return svg(f'<path d="M0 0{curves}" fill-rule="evenodd"/>')


@hostile
def stroked_scribble(n):
    r = random.Random(2)
    curves = chain(20_000, lambda i: f"Q{r.random() * 99:.2f} {r.random() * 99:.2f} {r.random() * 99:.2f} {r.random() * 99:.2f}")
    return svg(f'<path d="M0 0{curves}" fill="none" stroke="#0003" stroke-width="5" stroke-linejoin="round"/>')


@hostile
def wide_strokes_of_tight_arcs(n):
    arcs = chain(5000, lambda i: f'<path d="M{i % 99} {i // 99}a.01 .02 30 1 1 .005 0" fill="none" stroke="#0f02" stroke-width="60"/>')
    return svg(arcs)


@hostile
def translucent_circles(n):
    r = random.Random(3)
    return svg(chain(10_000, lambda i: f'<circle cx="{r.random() * 99:.2f}" cy="{r.random() * 99:.2f}" r="20" opacity=".1"/>'))


@hostile
def concentric_circles(n):
    return svg(chain(20_000, lambda i: f'<circle cx="50" cy="50" r="{50 - i / 400:.4f}" fill="#{i % 4096:03x}" fill-opacity=".5"/>'))


@hostile
def coincident_outlines(n):
    return svg(chain(100, lambda i: f'<circle cx="50" cy="{50 + i * 1e-5:.6f}" r="{40 + i * 1e-6:.6f}" opacity=".5" stroke="red"/>'))


@hostile
def blended_layers(n):
    modes = ["multiply", "screen", "hue", "color-dodge", "difference", "luminosity"]
    return svg(chain(3000, lambda i: f'<g style="mix-blend-mode:{modes[i % 6]}" opacity=".9"><circle cx="{i % 97}" cy="{i % 89}" r="45" fill="url(#g)"/></g>'),
               '<radialGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue" stop-opacity=".2"/></radialGradient>')


@hostile
def non_scaling_strokes(n):
    return svg(chain(5000, lambda i: f'<path transform="rotate({i})" vector-effect="non-scaling-stroke" stroke="#000" stroke-width="9" fill="none" d="M9 9C99 9 9 99 99 99"/>'))


# ---- paints and images ----------------------------------------------------------------------------

@hostile
def gradient_of_many_stops(n):
    stops = chain(20_000, lambda i: f'<stop offset="{i / 20_000}" stop-color="#{i * 37 % 4096:03x}"/>')
    return svg(chain(200, lambda i: f'<rect x="{i % 90}" y="{i // 3}" width="9" height="9" fill="url(#g)"/>'),
               f'<linearGradient id="g" spreadMethod="repeat" x2=".01">{stops}</linearGradient>')


@hostile
def large_image(n):
    return svg(f'<image width="99" height="99" href="{data_url(png(16000, 4000), "image/png")}"/>')


@hostile
def many_images(n):
    return svg(chain(40, lambda i: f'<image width="99" height="99" opacity=".9" href="{data_url(png(1000 + i, 1000), "image/png")}"/>'))


@hostile
def image_that_lies(n):
    data = bytearray(png(4, 4))
    data[16:24] = struct.pack(">II", 0x7fffffff, 0x7fffffff)
    return svg(f'<image width="99" height="99" href="{data_url(bytes(data), "image/png")}"/>')


# ---- text that is long ----------------------------------------------------------------------------

@hostile
def long_path(n):
    return svg('<path d="M0 0' + "l9 9-9-8" * 1_000_000 * n + '"/>')


@hostile
def long_points(n):
    r = random.Random(4)
    points = " ".join(f"{r.random() * 99:.3f},{r.random() * 99:.3f}" for _ in range(200_000 * n))
    return svg(f'<polygon points="{points}" fill-rule="evenodd"/>')


@hostile
def long_transform(n):
    return svg('<rect width="9" height="9" transform="' + "rotate(1)" * 200_000 * n + '"/>')


@hostile
def selectors_times_elements(n):
    rules = chain(20_000 * n, lambda i: f"g.a{i} > [x='{i}'] ~ .b{{fill:#{i % 4096:03x}}}")
    return svg('<g class="a1 a2 a3"><path x="1" class="b" d="M0 0h9v9"/></g>' * 2000, f"<style>{rules}</style>")


@hostile
def universal_selectors(n):
    return svg("<g/>" * 10_000, "<style>" + "* * * ~ *{fill:red}" * 10_000 * n + "</style>")


@hostile
def long_style(n):
    return svg('<rect width="9" height="9" style="' + "fill:red;" * 500_000 * n + '"/>')


@hostile
def many_attributes(n):
    return svg("<g " + chain(100_000 * n, lambda i: f'a{i}="" ') + '><rect width="9" height="9"/></g>')


@hostile
def many_namespaces(n):
    names = chain(20_000, lambda i: f'xmlns:n{i}="u{i}" ')
    return svg(f"<g {names}>" + '<n0:a/><rect width="9" height="9"/>' * 2000 * n + "</g>")


@hostile
def many_warnings(n):
    return svg('<rect width="nonsense" fill="url(#none)" clip-path="url(#none)"/>' * 50_000 * n)


@hostile
def many_languages(n):
    return svg('<switch><g systemLanguage="' + "xx," * 500_000 * n + '"/></switch>')


@hostile
def only_tags(n):
    return b"<" * 3_000_000 * n


@hostile
def unclosed_quotes(n):
    return svg("<style>" + "a{b:'" * 200_000 * n + "</style>")


@hostile
def open_brackets(n):
    return svg("<style>" + "a{b:(" * 200_000 * n + "</style>")


# ---- numbers --------------------------------------------------------------------------------------

@hostile
def huge_numbers(n):
    values = ["1e300", "-1e300", "1e38", "1e-300", "1e9", "nan", "inf", "0"]
    body = "".join(f'<rect x="{a}" width="{b}" height="1e30" transform="scale({a})" stroke="red" stroke-width="{b}" '
                   f'stroke-dasharray="{a} {b}"/><path d="M0 0C{a} {b} {b} {a} 99 99A{a} {b} 0 1 1 9 9"/>'
                   for a in values for b in values)
    return svg(body)


@hostile
def huge_picture(n):
    return svg('<circle cx="5e8" cy="5e8" r="4e8" stroke="red" stroke-dasharray="1" stroke-width="1e6"/>', size="1e9")


@hostile
def tiny_picture(n):
    return svg('<circle cx="5e-39" r="4e-39" stroke="red" stroke-width="1e-40"/>', size="1e-38")
