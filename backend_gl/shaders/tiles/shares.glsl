// Weights by paint: shares of a pixel's regions.
// Exports: minWeight, Share, noPaint, noShare, Shares, add, evictAll.

// Smaller weights are rounding errors.
const float minWeight = 1e-5;

// A paint, and the sum of the weights of pieces that have it on their left, less those that have it on their right;
// whether it counts in the part of the pixel that is asked for, which does not matter while the weight is 0.
struct Share {
    uint paint;
    float weight;
    bool counts;
};

const uint noPaint = 0xFFFFFFFFu;
const Share noShare = Share(noPaint, 0.0, false);

// The shares of the last two paints, mostly the two sides of a chain of pieces, are kept and added to. Another paint
// evicts the older one; evicted shares wait to be shaded: two at most, since pieces are added while none waits.
struct Shares {
    Share newer, older;
    Share waiting, last;
};

// An evicted share is shaded unless its weight is zero or it does not count.
void evict(inout Shares shares, Share share) {
    if (abs(share.weight) <= minWeight || !share.counts)
        return;
    if (shares.waiting.paint == noPaint)
        shares.waiting = share;
    else
        shares.last = share;
}

void add(inout Shares shares, Share term) {
    if (term.paint == shares.newer.paint) {
        shares.newer.weight += term.weight;
        shares.newer.counts = term.counts;
        return;
    }
    Share older = shares.older;
    shares.older = shares.newer;
    shares.newer = term;
    if (term.paint == older.paint)
        shares.newer.weight += older.weight;
    else
        evict(shares, older);
}

void evictAll(inout Shares shares) {
    evict(shares, shares.older);
    evict(shares, shares.newer);
    shares.older = shares.newer = noShare;
}
