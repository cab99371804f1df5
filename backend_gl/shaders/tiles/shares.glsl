// Weights by paint: shares of a pixel's regions.
// Requires: bool isShaded(uint paint, uint part), whether a share is shaded in a part of the pixel.
// Exports: minWeight, Share, noPaint, noShare, Shares, add, evictAll.

bool isShaded(uint paint, uint part);

// Smaller weights are rounding errors.
const float minWeight = 1e-5;

// A paint, and the sum of the weights of pieces that have it on their left, less those that have it on their right.
struct Share {
    uint paint;
    float weight;
};

const uint noPaint = 0xFFFFFFFFu;
const Share noShare = Share(noPaint, 0.0);

// The shares of the last two paints, mostly the two sides of a chain of pieces, are kept and added to. Another paint
// evicts the older one; evicted shares wait to be shaded: two at most, since pieces are added while none waits.
struct Shares {
    Share newer, older;
    Share waiting, last;
};

// An evicted share is shaded unless its weight is zero.
void evict(inout Shares shares, Share share, uint part) {
    if (abs(share.weight) <= minWeight || !isShaded(share.paint, part))
        return;
    if (shares.waiting.paint == noPaint)
        shares.waiting = share;
    else
        shares.last = share;
}

void add(inout Shares shares, Share term, uint part) {
    if (term.paint == shares.newer.paint) {
        shares.newer.weight += term.weight;
        return;
    }
    Share older = shares.older;
    shares.older = shares.newer;
    shares.newer = term;
    if (term.paint == older.paint)
        shares.newer.weight += older.weight;
    else
        evict(shares, older, part);
}

void evictAll(inout Shares shares, uint part) {
    evict(shares, shares.older, part);
    evict(shares, shares.newer, part);
    shares.older = shares.newer = noShare;
}
