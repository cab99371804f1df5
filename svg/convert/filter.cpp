// The `filter` property and filter elements: what the scene's filters are made of.

#include "svg/convert/filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "svg/convert/converter.hpp"

namespace vtm::svg {

/// One filter element for one element that it filters.
class Converter::FilterBuilder {
public:
    FilterBuilder(Converter& converter, const Element& filter, const Element& user, const Scope& scope,
                  const Box& box)
        : converter_(converter),
          chain_(converter.filterChain(filter)),
          user_(user),
          scope_(scope),
          box_(box),
          style_(converter.styleOf(filter)) {
        units_.ofBox = trim(inherited(chain_, "primitiveUnits")) == "objectBoundingBox";
        units_.box = box;
    }

    /// Whether one of its images would show the element that it filters.
    bool showsUser() const {
        for (const Element* owner : chain_)
            for (const Element* child : owner->children) {
                if (child->tag != Tag::FilterPrimitive || child->name != "feImage")
                    continue;
                const auto href = hrefOf(*child);
                if (href && converter_.tree_.byHref(*href) == &user_)
                    return true;
            }
        return false;
    }

    /// Nothing if the element is not rendered at all.
    std::shared_ptr<const scene::Filter> build() {
        const bool boxUnits = trim(inherited(chain_, "filterUnits")) != "userSpaceOnUse";
        const bool hasBox = box_.width() > 0 && box_.height() > 0;
        if ((boxUnits || units_.ofBox) && !hasBox)
            return nullptr;
        const Box region = regionIn(boxUnits);
        if (!(region.width() > 0 && region.height() > 0))
            return nullptr;
        filter_.transform = scope_.transform;
        filter_.min = region.min;
        filter_.max = region.max;
        for (const Element* owner : chain_) {
            for (const Element* child : owner->children)
                if (child->tag == Tag::FilterPrimitive)
                    add(*child);
            if (!filter_.primitives.empty())
                break;
        }
        if (filter_.primitives.empty())
            return nullptr;
        return std::make_shared<const scene::Filter>(std::move(filter_));
    }

private:
    std::optional<Length> lengthIn(std::string_view text) const {
        return parseLength(text, converter_.unitsFor(style_));
    }

    Box regionIn(bool boxUnits) const {
        const Viewport reference = boxUnits ? Viewport{1, 1} : scope_.viewport;
        const auto get = [&](std::string_view name, Axis axis, double percent) {
            return resolve(lengthIn(inherited(chain_, name)).value_or(Length{percent, true}), axis,
                           reference);
        };
        const Rect rect{get("x", Axis::X, -10), get("y", Axis::Y, -10), get("width", Axis::X, 120),
                        get("height", Axis::Y, 120)};
        return boxUnits ? geometry::mapped(toBox(rect), unitSquareTo(box_)) : toBox(rect);
    }

    void add(const Element& element) {
        limits::check();
        if (filter_.primitives.size() >= scene::maxPrimitives || !converter_.spend())
            return;
        const Style& style = converter_.styleOf(element);
        scene::FilterPrimitive primitive;
        primitive.linear = style.linearFilters;
        bool isFailed = false;
        if (element.name == "feImage")
            primitive.operation = scene::PictureFilter{};
        else if (auto operation = filterOperation(element, style, units_, isFailed))
            primitive.operation = std::move(*operation);
        else
            return converter_.reporter_.warn(Kind::Filter, element,
                                             "is not a filter primitive; it is left out");
        if (isFailed)
            converter_.reporter_.warn(Kind::Filter, element, "is in error; its result is transparent");
        addInputs(element, primitive);
        setSubregion(element, primitive);
        if (auto* picture = std::get_if<scene::PictureFilter>(&primitive.operation))
            picture->content = converter_.filterImage(element, scope_, {primitive.min, primitive.max});
        filter_.primitives.push_back(std::move(primitive));
        if (const std::string_view name = trim(element.get("result")); !name.empty())
            results_[name] = filter_.primitives.size() - 1;
    }

    // ---- Inputs ----

    void addInputs(const Element& element, scene::FilterPrimitive& primitive) {
        const auto count = inputCount(primitive.operation);
        if (count) {
            constexpr std::array<std::string_view, 2> names{"in", "in2"};
            for (std::size_t i = 0; i < *count; ++i)
                primitive.inputs.push_back(input(element, names[i]));
            return;
        }
        for (const Element* child : element.children)
            if (child->tag == Tag::FilterPrimitive && child->name == "feMergeNode")
                primitive.inputs.push_back(input(*child, "in"));
    }

    scene::FilterInput input(const Element& element, std::string_view attribute) {
        using Input = scene::FilterInput::Kind;
        const std::string_view name = trim(element.get(attribute));
        if (name == "SourceGraphic")
            return {Input::SourceGraphic};
        if (name == "SourceAlpha")
            return {Input::SourceAlpha};
        if (name == "FillPaint" || name == "StrokePaint")
            return {Input::Result, paintInput(name == "FillPaint")};
        if (const auto known = results_.find(name); known != results_.end())
            return {Input::Result, known->second};
        if (!name.empty())
            converter_.reporter_.warn(Kind::Filter, element,
                                      fmt::format("reads \"{}\", which is no result before it", name));
        const std::size_t before = filter_.primitives.size() - painted_;
        return before == 0 ? scene::FilterInput{Input::SourceGraphic}
                           : scene::FilterInput{Input::Result, last()};
    }

    /// The last primitive of the file's own.
    std::size_t last() const {
        std::size_t index = filter_.primitives.size() - 1;
        while (isPaint(index))
            --index;
        return index;
    }
    bool isPaint(std::size_t index) const { return std::ranges::find(paints_, index) != paints_.end(); }

    /// A primitive that shows the element's fill or stroke everywhere.
    std::size_t paintInput(bool fill) {
        auto& known = paints_[fill ? 0 : 1];
        if (known)
            return *known;
        const Style& style = scope_.style;
        auto content = std::make_shared<scene::Group>();
        const auto paint = converter_.paint(fill ? style.fill : style.stroke, user_, scope_, box_);
        if (paint)
            content->children.push_back(
                {scene::Item{std::make_shared<const scene::Path>(scene::rectangle(filter_.min, filter_.max)),
                             scope_.transform, scene::FillRule::NonZero, *paint,
                             static_cast<float>(fill ? style.fillOpacity : style.strokeOpacity),
                             converter_.placeOf(user_)}});
        filter_.primitives.push_back(
            {scene::PictureFilter{std::move(content)}, {}, filter_.min, filter_.max, false});
        ++painted_;
        known = filter_.primitives.size() - 1;
        return *known;
    }

    // ---- Subregions ----

    /// Around the inputs that are results, unless one is the source or the operation is one of its own.
    Box defaultSubregion(const scene::FilterPrimitive& primitive) const {
        const Box whole{filter_.min, filter_.max};
        const bool isTile = std::holds_alternative<scene::TileFilter>(primitive.operation);
        Box around;
        for (const scene::FilterInput& input : primitive.inputs) {
            if (isTile || input.kind != scene::FilterInput::Kind::Result)
                return whole;
            around.add(Box{filter_.primitives[input.result].min, filter_.primitives[input.result].max});
        }
        return primitive.inputs.empty() ? whole : around;
    }

    void setSubregion(const Element& element, scene::FilterPrimitive& primitive) {
        const Box standard = defaultSubregion(primitive);
        const auto given = [&](std::string_view name, Axis axis) -> std::optional<double> {
            const auto length = lengthIn(element.get(name));
            if (!length)
                return std::nullopt;
            if (!units_.ofBox)
                return resolve(*length, axis, scope_.viewport);
            const double share = resolve(*length, axis, {1, 1});
            return axis == Axis::X ? units_.x(share) : units_.y(share);
        };
        const scene::Point corner = units_.ofBox ? box_.min : scene::Point(0);
        const auto x = given("x", Axis::X), y = given("y", Axis::Y);
        primitive.min = {x ? corner.x + *x : standard.min.x, y ? corner.y + *y : standard.min.y};
        const scene::Point size{given("width", Axis::X).value_or(standard.width()),
                                given("height", Axis::Y).value_or(standard.height())};
        primitive.max = primitive.min + glm::max(size, scene::Point(0));
    }

    using Kind = Warning::Kind;
    Converter& converter_;
    const TemplateChain chain_;
    const Element& user_;
    const Scope& scope_;
    const Box box_;
    const Style& style_;
    PrimitiveUnits units_;
    scene::Filter filter_;
    std::unordered_map<std::string_view, std::size_t> results_;
    std::array<std::optional<std::size_t>, 2> paints_;  ///< primitives that show the fill, the stroke
    std::size_t painted_ = 0;
};

/// The filter and the templates that it refers to.
TemplateChain Converter::filterChain(const Element& filter) {
    TemplateChain chain;
    std::unordered_set<const Element*> seen;
    for (const Element* next = &filter; next && next->tag == Tag::Filter && seen.insert(next).second;) {
        limits::check();
        chain.push_back(next);
        const auto href = hrefOf(*next);
        next = href ? tree_.byHref(*href) : nullptr;
        if (href && (!next || next->tag != Tag::Filter))
            reporter_.warn(Kind::Reference, filter,
                           fmt::format("refers to \"{}\", which is no filter", *href));
    }
    return chain;
}

/// What feImage shows: an element of the file, moved to the subregion's corner, or an image in the subregion.
scene::Link<scene::Group> Converter::filterImage(const Element& element, const Scope& scope,
                                                 const Box& region) {
    auto content = std::make_shared<scene::Group>();
    const auto href = hrefOf(element);
    if (!href || href->empty()) {
        reporter_.warn(Kind::Reference, element, "has no href; its result is transparent");
        return content;
    }
    Scope inner = scope;
    ++inner.depth;
    Nodes nodes;
    if (const Element* target = tree_.byHref(*href)) {
        inner.style = target->parent ? styleOf(*target->parent) : Style{};
        inner.transform = scene::compose(scope.transform, scene::translation(region.min.x, region.min.y));
        const Level level(*this, element);
        if (level)
            withoutOutlines([&] { convertElement(*target, inner, nodes); });
    } else if (href->starts_with('#')) {
        reporter_.warn(Kind::Reference, element,
                       fmt::format("refers to \"{}\", which is not here; its result is transparent", *href));
    } else {
        inner.style = styleOf(element);
        const Rect viewport{region.min.x, region.min.y, region.width(), region.height()};
        const AspectRatio ratio = parseAspectRatio(element.get("preserveAspectRatio"));
        const ImageContent image = imageContent(*href, element);
        if (!(region.width() > 0 && region.height() > 0) ||
            !isWithinReach(geometry::mapped(region, scope.transform)))
            return content;
        if (const auto* bitmap = std::get_if<std::shared_ptr<const image::Bitmap>>(&image))
            placeBitmap(*bitmap, element, viewport, ratio, inner, nodes);
        else if (const auto* document = std::get_if<std::shared_ptr<NestedDocument>>(&image))
            withoutOutlines([&] { placeNested(**document, element, viewport, ratio, inner, nodes); });
    }
    content->children = std::move(nodes);
    return content;
}

std::optional<FilterList> Converter::filtersOf(const Element& element, const Scope& scope, const Box& box) {
    FilterList filters;
    const auto values = parseFilterList(scope.style.filter, unitsFor(scope.style));
    for (const FilterValue& value : values.value_or(std::vector<FilterValue>{})) {
        if (const auto* function = std::get_if<FilterFunction>(&value)) {
            filters.push_back(std::make_shared<const scene::Filter>(
                filterOf(*function, resolveColor(function->color, scope.style), scope.transform)));
            continue;
        }
        const std::string_view href = std::get<FilterReference>(value).href;
        const Element* filter = resource(href, Tag::Filter, element);
        if (!filter && values->size() == 1)
            return std::nullopt;
        if (!filter)
            continue;
        const Expansion expansion(active_, *filter);
        if (!expansion) {
            reporter_.warn(Kind::Reference, *filter, "refers to itself, directly or indirectly");
            continue;
        }
        FilterBuilder builder(*this, *filter, element, scope, box);
        if (builder.showsUser()) {
            reporter_.warn(Kind::Reference, *filter, "shows the element that it filters; it is not applied");
            continue;
        }
        auto built = builder.build();
        if (!built)
            return std::nullopt;
        filters.push_back(std::move(built));
    }
    return filters;
}

}  // namespace vtm::svg
