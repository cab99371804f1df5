#include "conformance/generate/src/hard/families.hpp"

namespace vtm::generate {

using namespace scene;

namespace {

Path shape(Sketch& s) {
    if (s.random.chance(0.3))
        return s.anyCircle();
    if (s.random.chance(0.3))
        return s.anyRectangle();
    std::vector<Point> points;
    for (int i = s.random.integer(3, 7); i > 0; --i)
        points.push_back(s.point());
    return polygon(points);
}

std::shared_ptr<const Clip> clip(Sketch& s, int levels) {
    auto clip = std::make_shared<Clip>();
    for (int i = s.random.integer(1, 3); i > 0; --i)
        clip->shapes.push_back(
            {std::make_shared<Path>(shape(s)), identity, s.random.any(FillRule::EvenOdd),
             levels > 0 && s.random.chance(0.3) ? generate::clip(s, levels - 1) : nullptr});
    if (levels > 0 && s.random.chance(0.6))
        clip->clip = generate::clip(s, levels - 1);
    return clip;
}

Group group(Sketch& s, int levels, BlendMode lastBlend) {
    Group group;
    for (int i = s.random.integer(1, 3); i > 0; --i) {
        if (levels > 0 && s.random.chance(0.6))
            group.children.push_back({generate::group(s, levels - 1, lastBlend)});
        else
            s.fillAny(shape(s), &group);
    }
    if (s.random.chance(0.6))
        group.opacity = float(s.random.uniform(0, 1));
    group.blend = s.random.any(lastBlend);
    return group;
}

/// Bands of one colour or ramps between jumps.
std::vector<GradientStop> jumps(Sketch& s) {
    std::vector<GradientStop> stops{{0, s.color()}};
    const int count = s.random.integer(1, 4);
    for (int i = 1; i <= count; ++i) {
        const float offset = float(i) / float(count + 1);
        stops.push_back({offset, s.random.chance(0.7) ? stops.back().color : s.color()});
        stops.push_back({offset, s.color()});
    }
    stops.push_back({1, s.random.chance(0.7) ? stops.back().color : s.color()});
    return stops;
}

std::vector<GradientStop> smooth(Sketch& s) {
    std::vector<GradientStop> stops;
    const int count = s.random.integer(1, 4);
    for (int i = 0; i <= count; ++i)
        stops.push_back({float(i) / float(count), s.color()});
    return stops;
}

/// Its length is between shares of the picture's side.
Paint gradient(Sketch& s, std::vector<GradientStop> stops, double shortest, double longest) {
    const double reach = s.random.magnitude(shortest, longest) * s.side();
    const Point a = s.inside();
    if (s.random.chance(0.6))
        return LinearGradient{a, polar(a, reach, s.random.uniform(0, 2 * pi)), std::move(stops),
                              s.random.any(Spread::Repeat)};
    const double off = s.random.uniform(0, 0.7) * reach;
    return RadialGradient{a,
                          reach,
                          polar(a, off, s.random.uniform(0, 2 * pi)),
                          0,
                          std::move(stops),
                          s.random.any(Spread::Repeat)};
}

void paint(Sketch& s, Paint paint) { s.fillAny(shape(s)).paint = std::move(paint); }

}  // namespace

Scene transforms(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(2, 8); i > 0; --i) {
        const double sign = s.random.chance(0.5) ? 1 : -1, flat = sign * s.random.magnitude(1e-9, 1);
        const double shear = s.random.chance(0.5) ? 0 : s.random.uniform(-100, 100);
        const double turn = s.random.uniform(0, 2 * pi), size = s.random.magnitude(0.1, 10);
        const Affine turned = about(s.inside(), turn, size, flat);
        Item& item = s.fillAny(shape(s));
        item.transform = compose(turned, Affine{1, 0, shear, 1, -shear * 32, 0});
        // As large as the transform is small, so that something shows.
        if (s.random.chance(0.5))
            item.transform = compose(item.transform, about({32, 32}, 0, 1, 1 / std::abs(flat)));
    }
    return s.scene;
}

Scene nestedClips(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        Group group = generate::group(s, 1, BlendMode::Normal);
        group.clip = clip(s, 3);
        s.scene.root.children.push_back({std::move(group)});
    }
    return s.scene;
}

Scene blends(std::uint64_t seed) {
    Sketch s(seed);
    s.fill(shape(s));
    for (int i = s.random.integer(2, 4); i > 0; --i)
        s.scene.root.children.push_back({group(s, 3, BlendMode::PlusLighter)});
    return s.scene;
}

Scene crowds(std::uint64_t seed) {
    Sketch s(seed);
    const float alpha = float(s.random.uniform(0.01, 0.5));
    for (int i = s.random.integer(10, 50); i > 0; --i)
        s.fillAny(shape(s)).opacity = alpha;
    return s.scene;
}

Scene selections(std::uint64_t seed) {
    Sketch s(seed);
    const auto side = [&](int levels) {
        return s.random.chance(0.2) ? nullptr : std::make_shared<Group>(group(s, levels, BlendMode::Normal));
    };
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        const Shape mask{std::make_shared<Path>(shape(s)), identity, s.random.any(FillRule::EvenOdd)};
        const auto inside = side(1);
        s.scene.root.children.push_back({Select{mask, inside, side(1)}});
    }
    return s.scene;
}

Scene masks(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 3); i > 0; --i) {
        auto content = std::make_shared<Group>(group(s, 1, BlendMode::Normal));
        Group masked = group(s, 1, BlendMode::Normal);
        const auto kind = s.random.any(MaskKind::Alpha);
        masked.mask = std::make_shared<Mask>(Mask{std::move(content), kind, s.random.chance(0.5)});
        s.scene.root.children.push_back({std::move(masked)});
    }
    return s.scene;
}

Scene patterns(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 2); i > 0; --i) {
        // The tile is a part of what is drawn over the whole picture.
        const auto content = std::make_shared<Group>(group(s, 0, BlendMode::Normal));
        const Point min = s.inside(0.1), max = min + s.random.point(0.1, 0.6) * s.size();
        const double turn = s.random.chance(0.4) ? 0 : s.random.uniform(0, 2 * pi);
        const double width = s.random.chance(0.3) ? 1 : s.random.uniform(0.3, 2);
        const Affine there = about({32, 32}, turn, width, s.random.uniform(0.3, 2));
        paint(s, Pattern{min, max, content, there});
    }
    return s.scene;
}

Scene hardStops(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 3); i > 0; --i)
        paint(s, gradient(s, jumps(s), 0.1, 2));
    return s.scene;
}

Scene ramps(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i)
        paint(s, gradient(s, smooth(s), 0.5, 4));
    return s.scene;
}

}  // namespace vtm::generate
