#include "svg/css/cascade.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <tuple>
#include <unordered_map>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "svg/css/conditions.hpp"
#include "svg/css/css.hpp"
#include "svg/css/cursor.hpp"
#include "svg/css/style.hpp"
#include "svg/css/variables.hpp"
#include "svg/xml/decode.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {
namespace {

/// Comparisons spent on matching selectors, some seconds: hostile sheets could ask for minutes.
constexpr long maxMatchingSteps = 300'000'000;

/// One selector and the rule that it stands for.
struct Candidate {
    const Selector* selector;
    const Rule* rule;
    std::size_t layer, order;  ///< the higher one wins
};

/// Selectors by what their last compound asks for, so that an element is compared with few.
class SelectorIndex {
public:
    /// `layer`: its rank.
    void add(const Rule& rule, std::size_t layer) {
        for (const Selector& selector : rule.selectors)
            keyed_[keyOf(selector.compounds.back())].push_back({&selector, &rule, layer, order_++});
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
        for (Cursor classes(element.get("class")); !classes.atEnd();)
            collect(classes.nextInList());
        std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
            return std::tuple(a.layer, a.selector->specificity, a.order) <
                   std::tuple(b.layer, b.selector->specificity, b.order);
        });
        const auto repeated = std::ranges::unique(found, {}, &Candidate::order);
        found.erase(repeated.begin(), repeated.end());
        return found;
    }

private:
    using Key = std::string_view;

    /// An id, else a class, else a type, else nothing. An id that is spelt like a class or a type does no
    /// harm: the selector is compared in full.
    static Key keyOf(const Compound& last) {
        for (const ConditionKind kind : {ConditionKind::Id, ConditionKind::Class})
            for (const Condition& condition : last.conditions)
                if (condition.kind == kind)
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
        if (const Property* property = findDeclared(raw.name);
            property && !hasVariables(raw.value) && !isValid(*property, raw.value))
            reporter.warnInvalid(element, raw.name, raw.value);
}

/// Sheets with what they import, in the order of the cascade.
class SheetReader {
public:
    SheetReader(Tree& tree, const Options& options, Reporter& reporter)
        : tree_(tree), options_(options), reporter_(reporter) {}

    /// Reads the rules of a sheet that stands in `element`; its fonts go to the tree.
    void read(std::string_view text, const Element& element) {
        read(text, element, 0, options_.resourceDirectory);
    }
    const Layers& layers() const { return layers_; }

    /// What stands in `<?xml-stylesheet type="text/css" href="…" media="…"?>`.
    void readLinked(std::string_view instruction) {
        const std::string_view type = attributeOf(instruction, "type"),
                               href = attributeOf(instruction, "href");
        const bool isCss = type.empty() || equalsIgnoringCase(type, "text/css");
        if (isCss && !href.empty() && attributeOf(instruction, "alternate") != "yes" &&
            mediaHolds(attributeOf(instruction, "media")))
            readImport({href, {}}, *tree_.root, options_.resourceDirectory);
    }
    std::vector<Rule> take() { return std::move(rules_); }

private:
    /// `name="value"`, empty if it is not there.
    static std::string_view attributeOf(std::string_view text, std::string_view name) {
        for (Cursor cursor(text); !cursor.atEnd();) {
            cursor.skipSpaces();
            const std::string_view found = cursor.identifier();
            cursor.skipSpaces();
            if (!cursor.consume('='))
                return {};
            cursor.skipSpaces();
            const char quote = cursor.peek();
            if (quote != '"' && quote != '\'')
                return {};
            cursor.advance();
            const std::string_view value = cursor.until(quote);
            if (found == name)
                return value;
        }
        return {};
    }

    /// `directory`: where its references start.
    void read(std::string_view text, const Element& element, std::size_t layer,
              const std::string& directory) {
        StyleSheet sheet = parseStyleSheet(text, layers_, layer);
        for (const Import& import : sheet.imports)
            if (mediaHolds(import.media))
                readImport(import, element, directory);
        for (const std::string_view rule : sheet.ignored)
            reporter_.warn(Warning::Kind::Value, element, "the rule " + quoted(rule) + " is ignored");
        for (Rule& rule : sheet.rules) {
            check(element, rule.declarations, reporter_);
            rules_.push_back(std::move(rule));
        }
        for (const std::vector<RawDeclaration>& descriptors : sheet.fontFaces) {
            FontFaceRule& rule = tree_.fontFaces.emplace_back();
            rule.sheet = &element;
            rule.directory = directory;
            for (const RawDeclaration& descriptor : descriptors)
                rule.descriptors.push_back({descriptor.name, descriptor.value});
        }
    }

    /// A sheet that imports itself, by others too, is read once.
    void readImport(const Import& import, const Element& element, const std::string& directory) {
        constexpr std::size_t maxImports = 8;  // of sheets in each other
        const auto file = (std::filesystem::path(directory) / percentDecoded(import.href)).lexically_normal();
        if (std::ranges::find(open_, file) != open_.end())
            return reporter_.warn(Warning::Kind::Reference, element,
                                  "style sheets import each other in a circle");
        if (open_.size() == maxImports)
            return reporter_.warn(Warning::Kind::Reference, element,
                                  "style sheets import each other too deeply");
        open_.push_back(file);
        try {
            const std::string text =
                decodeText(readResource(import.href, directory, options_.resourceRoot), file.string());
            read(tree_.ownedText.emplace_back(withoutComments(text)), element, import.layer,
                 isDataUrl(import.href) ? directory : file.parent_path().string());
        } catch (const limits::Exceeded&) {
            throw;
        } catch (const std::runtime_error& error) {
            reporter_.warn(Warning::Kind::Reference, element,
                           "the style sheet " + quoted(import.href) + " cannot be read: " + error.what());
        }
        open_.pop_back();
    }

    Tree& tree_;
    const Options& options_;
    Reporter& reporter_;
    Layers layers_;
    std::vector<Rule> rules_;
    std::vector<std::filesystem::path>
        open_;  ///< sheets that are being read, each imported by the one before
};

void readSheets(SheetReader& reader, Tree& tree, const Options& options) {
    reader.read(tree.ownedText.emplace_back(withoutComments(options.styleSheet)), *tree.root);
    for (const std::string_view instruction : tree.styleSheets)
        reader.readLinked(instruction);
    for (const Element& element : tree.elements)
        if (element.tag == Tag::Style && isCss(element) && mediaHolds(element.get("media")))
            reader.read(sheetText(element, tree), element);
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

/// The property that an attribute stands for. Paint servers call `transform` by other names (CSS Transforms 1
/// section 5).
std::string_view propertyOf(Tag tag, std::string_view attribute) {
    const bool isGradient = tag == Tag::LinearGradient || tag == Tag::RadialGradient;
    if (!isGradient && tag != Tag::Pattern)
        return attribute;
    if (attribute == (isGradient ? "gradientTransform" : "patternTransform"))
        return "transform";
    return attribute == "transform" ? std::string_view{} : attribute;
}

void addPresentationAttributes(Element& element, Tree& tree, Reporter& reporter) {
    for (const Attribute& attribute : element.attributes) {
        const Property* property = findProperty(propertyOf(element.tag, attribute.name));
        if (!property || !property->attribute)
            continue;
        const std::string_view value = trim(cleaned(attribute.value, tree));
        if (isStyled(element.tag) && !hasVariables(value) && !isValid(*property, value))
            reporter.warnInvalid(element, attribute.name, attribute.value);
        element.declarations.push_back({property, value});
    }
}

/// Fills the declarations of elements, in the order of the document.
class Declarer {
public:
    Declarer(Tree& tree, Reporter& reporter) : tree_(tree), reporter_(reporter) {}

    void declare(Element& element, std::vector<Candidate> rules) {
        addPresentationAttributes(element, tree_, reporter_);
        const auto style = parseDeclarations(cleaned(element.get("style"), tree_));
        if (isStyled(element.tag))
            check(element, style, reporter_);
        std::shared_ptr<Variables> own;
        for (const bool important : {false, true}) {
            // Which turns the order of layers round (CSS Cascade 5 section 6.4).
            if (important && !std::ranges::is_sorted(rules, std::greater(), &Candidate::layer))
                std::ranges::stable_sort(rules, std::greater(), &Candidate::layer);
            for (const Candidate& candidate : rules)
                add(element, candidate.rule->declarations, important, own);
            add(element, style, important, own);
        }
        const std::shared_ptr<const Variables> variables = own ? own : inherited(element);
        if (variables)
            variables_.emplace(&element, variables);
        substitute(element, variables.get());
    }

private:
    std::shared_ptr<const Variables> inherited(const Element& element) const {
        const auto found = variables_.find(element.parent);
        return found == variables_.end() ? nullptr : found->second;
    }

    void add(Element& element, const std::vector<RawDeclaration>& declarations, bool important,
             std::shared_ptr<Variables>& own) {
        for (const RawDeclaration& raw : declarations) {
            if (raw.important != important)
                continue;
            if (const Property* property = findDeclared(raw.name)) {
                element.declarations.push_back({property, raw.value});
            } else if (raw.name.starts_with("--")) {
                if (!own)
                    own = std::make_shared<Variables>(inherited(element));
                own->declare(raw.name, raw.value);
            }
        }
    }

    /// A value that cannot be had counts as unset (CSS Custom Properties 1 section 3.1).
    void substitute(Element& element, const Variables* variables) {
        static const Variables none(nullptr);
        for (Declaration& declaration : element.declarations) {
            if (!hasVariables(declaration.value))
                continue;
            const auto value = (variables ? *variables : none).substituted(declaration.value);
            const bool holds = value && isValid(*declaration.property, trim(*value));
            declaration.value =
                holds ? trim(tree_.ownedText.emplace_back(*value)) : std::string_view("unset");
        }
    }

    Tree& tree_;
    Reporter& reporter_;
    std::unordered_map<const Element*, std::shared_ptr<const Variables>> variables_;
};

}  // namespace

void cascade(Tree& tree, const Options& options, Reporter& reporter) {
    const limits::Stage stage("matching styles");
    SheetReader reader(tree, options, reporter);
    readSheets(reader, tree, options);
    const std::vector<Rule> rules = reader.take();
    const std::vector<std::size_t> ranks = reader.layers().ranks();
    SelectorIndex index;
    for (const Rule& rule : rules)
        index.add(rule, ranks[rule.layer]);
    Declarer declarer(tree, reporter);
    long steps = maxMatchingSteps;
    for (Element& element : tree.elements) {
        limits::check();
        if (element.tag != Tag::CharacterData)
            declarer.declare(element, index.match(element, steps));
    }
    if (steps <= 0)
        reporter.warn(Warning::Kind::Limit, *tree.root,
                      "the style sheets are too expensive to match; some rules are left out");
}

}  // namespace vtm::svg
