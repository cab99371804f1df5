#include "svg/css/cascade.hpp"

#include <algorithm>
#include <unordered_map>

#include <vtm/limits/limits.hpp>
#include "svg/css/css.hpp"
#include "svg/css/cursor.hpp"
#include "svg/css/style.hpp"

namespace vtm::svg {
namespace {

/// Comparisons spent on matching selectors, some seconds: hostile sheets could ask for minutes.
constexpr long maxMatchingSteps = 300'000'000;

/// One selector and the rule that it stands for.
struct Candidate {
    const Selector* selector;
    const Rule* rule;
    std::size_t order;
};

/// Selectors by what their last compound asks for, so that an element is compared with few.
class SelectorIndex {
public:
    void add(const Rule& rule) {
        for (const Selector& selector : rule.selectors)
            keyed_[keyOf(selector.compounds.back())].push_back({&selector, &rule, order_++});
    }

    std::vector<Candidate> match(const Element& element, long& steps) const {
        std::vector<Candidate> found;
        const auto collect = [&](Key key) {
            if (const auto list = keyed_.find(key); list != keyed_.end())
                std::copy_if(list->second.begin(), list->second.end(), std::back_inserter(found),
                             [&](const Candidate& c) { return matches(*c.selector, element, steps); });
        };
        collect({});
        collect(element.name);
        if (const auto id = element.find("id"))
            collect(*id);
        std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
            return std::pair(a.selector->specificity, a.order) < std::pair(b.selector->specificity, b.order);
        });
        return found;
    }

private:
    using Key = std::string_view;

    /// An id, else a type, else nothing. An id that is spelt like a type does no harm: the selector
    /// is compared in full.
    static Key keyOf(const Compound& last) {
        for (const Condition& condition : last.conditions)
            if (condition.kind == ConditionKind::Id)
                return condition.value;
        return last.type;
    }

    std::unordered_map<Key, std::vector<Candidate>> keyed_;
    std::size_t order_ = 0;
};

bool isCss(const Element& style) {
    const std::string_view type = trim(style.get("type"));
    return type.empty() || equalsIgnoringCase(type, "text/css");
}

std::string_view sheetText(const Element& style, Tree& tree) {
    std::string text;
    for (const Element* child : style.children)
        if (child->tag == Tag::CharacterData)
            text += child->text;
    return tree.ownedText.emplace_back(withoutComments(text));
}

/// Declarations of known properties, whose values are none of theirs.
void check(const Element& element, const std::vector<RawDeclaration>& declarations, Reporter& reporter) {
    for (const RawDeclaration& raw : declarations)
        if (const Property* property = findProperty(raw.name); property && !isValid(*property, raw.value))
            reporter.warnInvalid(element, raw.name, raw.value);
}

/// Appends the rules of a sheet that stands in `element`; its fonts go to the tree.
void readSheet(std::string_view text, const Element& element, Tree& tree, std::vector<Rule>& rules,
               Reporter& reporter) {
    StyleSheet sheet = parseStyleSheet(text);
    for (Rule& rule : sheet.rules) {
        check(element, rule.declarations, reporter);
        rules.push_back(std::move(rule));
    }
    for (const std::vector<RawDeclaration>& descriptors : sheet.fontFaces) {
        FontFaceRule& rule = tree.fontFaces.emplace_back();
        rule.sheet = &element;
        for (const RawDeclaration& descriptor : descriptors)
            rule.descriptors.push_back({descriptor.name, descriptor.value});
    }
}

std::vector<Rule> readSheets(Tree& tree, std::string_view sheet, Reporter& reporter) {
    std::vector<Rule> rules;
    readSheet(tree.ownedText.emplace_back(withoutComments(sheet)), *tree.root, tree, rules, reporter);
    for (const Element& element : tree.elements)
        if (element.tag == Tag::Style && isCss(element))
            readSheet(sheetText(element, tree), element, tree, rules, reporter);
    return rules;
}

/// Values in attributes may hold CSS comments too.
std::string_view cleaned(std::string_view text, Tree& tree) {
    return text.find("/*") == text.npos ? text : tree.ownedText.emplace_back(withoutComments(text));
}

/// Elsewhere attributes may be called like properties and mean something else, as `fill` of animations does.
bool isStyled(Tag tag) {
    constexpr Tag others[]{Tag::Unknown,         Tag::Foreign, Tag::Animation, Tag::Descriptive,
                           Tag::FilterPrimitive, Tag::Script,  Tag::Style};
    return std::find(std::begin(others), std::end(others), tag) == std::end(others);
}

void addPresentationAttributes(Element& element, Tree& tree, Reporter& reporter) {
    for (const Attribute& attribute : element.attributes) {
        const Property* property = findProperty(attribute.name);
        if (!property || !property->attribute)
            continue;
        const std::string_view value = trim(cleaned(attribute.value, tree));
        if (isStyled(element.tag) && !isValid(*property, value))
            reporter.warnInvalid(element, attribute.name, attribute.value);
        element.declarations.push_back({property, value});
    }
}

void add(Element& element, const std::vector<RawDeclaration>& declarations, bool important) {
    for (const RawDeclaration& raw : declarations)
        if (const Property* property = findProperty(raw.name); property && raw.important == important)
            element.declarations.push_back({property, raw.value});
}

void addAll(Element& element, const std::vector<Candidate>& rules, Tree& tree, Reporter& reporter) {
    addPresentationAttributes(element, tree, reporter);
    const auto style = parseDeclarations(cleaned(element.get("style"), tree));
    if (isStyled(element.tag))
        check(element, style, reporter);
    for (const bool important : {false, true}) {
        for (const Candidate& candidate : rules)
            add(element, candidate.rule->declarations, important);
        add(element, style, important);
    }
}

}  // namespace

void cascade(Tree& tree, std::string_view sheet, Reporter& reporter) {
    const limits::Stage stage("matching styles");
    const std::vector<Rule> rules = readSheets(tree, sheet, reporter);
    SelectorIndex index;
    for (const Rule& rule : rules)
        index.add(rule);
    long steps = maxMatchingSteps;
    for (Element& element : tree.elements) {
        limits::check();
        if (element.tag != Tag::CharacterData)
            addAll(element, index.match(element, steps), tree, reporter);
    }
    if (steps <= 0)
        reporter.warn(Warning::Kind::Limit, *tree.root,
                      "the style sheets are too expensive to match; some rules are left out");
}

}  // namespace vtm::svg
