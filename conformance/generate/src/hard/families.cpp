#include "conformance/generate/src/hard/families.hpp"

#include "conformance/generate/generate.hpp"

namespace vtm::generate {
namespace {

constexpr Family families[] = {{"slivers", slivers},
                               {"fans", fans},
                               {"nearly-coincident", nearlyCoincident},
                               {"cusps", cusps},
                               {"concentric", concentric},
                               {"self-overlaps", selfOverlaps},
                               {"huge", huge},
                               {"tiny", tiny},
                               {"hairline-grids", hairlineGrids},
                               {"abutting", abutting},
                               {"hairlines", hairlines},
                               {"dashes", dashes},
                               {"stroked-arcs", strokedArcs},
                               {"turning-miters", turningMiters},
                               {"empty-segments", emptySegments},
                               {"stroked-curves", strokedCurves},
                               {"extreme-strokes", extremeStrokes},
                               {"pens", pens},
                               {"transforms", transforms},
                               {"nested-clips", nestedClips},
                               {"blends", blends},
                               {"crowds", crowds},
                               {"selections", selections},
                               {"masks", masks},
                               {"patterns", patterns},
                               {"hard-stops", hardStops},
                               {"ramps", ramps},
                               {"cell-borders", cellBorders},
                               {"cell-corners", cellCorners},
                               {"border-runs", borderRuns},
                               {"border-curves", borderCurves},
                               {"lattice-steps", latticeSteps},
                               {"long-pictures", longPictures},
                               {"scaled-pictures", scaledPictures},
                               {"far-arcs", farArcs}};

}  // namespace

std::span<const Family> hardFamilies() { return families; }

}  // namespace vtm::generate
