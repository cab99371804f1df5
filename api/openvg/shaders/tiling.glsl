// What is outside of an image (specification section 9.4.1). Requires: nothing. Twin of: tiled() in
// api/openvg/image/filter_images.cpp. Exports: inside.

const int tileFill = 0x1D00, tilePad = 0x1D01, tileRepeat = 0x1D02;  // VGTilingMode

// A column or a row of the image; -1: the fill colour.
int inside(int i, int size, int tiling) {
    if (i >= 0 && i < size)
        return i;
    if (tiling == tileFill)
        return -1;
    if (tiling == tilePad)
        return i < 0 ? 0 : size - 1;
    int tile = i < 0 ? -((size - 1 - i) / size) : i / size;
    int place = i - size * tile;
    return tiling == tileRepeat || (tile & 1) == 0 ? place : size - 1 - place;
}
