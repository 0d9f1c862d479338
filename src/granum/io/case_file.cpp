#include "granum/io/case_file.hpp"

#include "granum/base/type_list.hpp"
#include "granum/io/case_text.hpp"
#include "granum/io/hash.hpp"
#include "granum/io/text_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

namespace granum::io
{
namespace
{
namespace fs = std::filesystem;

struct Material
{
    std::string name, file;
    toml::table values;
};
}

struct CaseFile::Inside
{
    std::string path, home, text;
    toml::table root;
    std::set<std::string> known;  //!< general keys that were asked for
    std::set<std::string> sections;
    std::set<std::string> wrong;
    std::vector<base::Mistake> mistakes;
    std::vector<std::pair<std::string, base::Mistake>> missing;  //!< by key, reported unless a typo explains them
    std::vector<Provenance> provenance;
    std::map<std::string, std::set<std::string>> doubtful;  //!< values of low confidence in use, by material
    std::vector<std::string> warnings;
    std::map<std::string, Material> materials;  //!< by section

    toml::node const* find(std::string const& key) const { return root.at_path(key).node(); }

    int line_of(std::string const& key) const
    {
        for (std::string at = key; !at.empty(); at = parent(at))
            if (auto const* node = find(at)) return static_cast<int>(node->source().begin.line);
        return 1;
    }

    void fault(std::string const& key, std::string const& what, std::vector<std::string> hints)
    {
        wrong.insert(key);
        auto const* node = find(key);
        mistakes.push_back({path, line_of(key),
                            node && !node->is_table() && !node->is_array_of_tables()
                                ? fmt::format("{} = {}", key, as_written(*node))
                                : key,
                            what, std::move(hints)});
    }

    void note(std::string const& key, std::string const& value, std::string const& origin, std::string const& doc)
    {
        provenance.push_back({key, value, origin, doc});
    }

    std::string line_origin(toml::node const& node) const { return fmt::format("line {}", node.source().begin.line); }

    //! The node of a key, from the file or from the section's material; null where there is none.
    toml::node const* look(std::string const& key, std::string& origin)
    {
        known.insert(general(key));
        if (auto const* node = find(key)) {
            origin = line_origin(*node);
            return node;
        }
        auto const found = materials.find(parent(key));
        if (found == materials.end()) return nullptr;
        auto const entry = key.substr(parent(key).size() + 1);
        auto const* property = found->second.values[entry].as_table();
        auto const* value = property ? property->get("value") : nullptr;
        if (!value) return nullptr;
        auto const mark = (*property)["mark"].value_or(std::string());
        auto const source = (*property)["source"].value_or(std::string("no source given"));
        origin = fmt::format("material {} ({}{}{})", found->second.name, mark, mark.empty() ? "" : "; ", source);
        if (mark.find("recalled") != std::string::npos || mark.find("low") != std::string::npos)
            doubtful[found->second.name].insert(fmt::format("{} = {}", entry, as_written(*value)));
        return value;
    }

    void absent(std::string const& key, std::string const& doc, std::string const& example)
    {
        wrong.insert(key);
        missing.push_back({key,
                           {path,
                            line_of(key),
                            key,
                            "is missing",
                            {fmt::format("{}{}", doc, example.empty() ? "" : fmt::format(", e.g. {}", example))}}});
    }

    //! One number with its unit; NaN and a mistake where it is wrong.
    double number(toml::node const& node, std::string const& key, Dimension dimension)
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        if (auto const* quoted = node.as_string()) {
            try {
                return read_quantity(quoted->get(), dimension);
            } catch (QuantityError const& wrong_text) {
                std::vector<std::string> hints;
                if (!wrong_text.hint.empty()) hints.push_back(wrong_text.hint);
                fault(key, wrong_text.what(), hints);
                return none;
            }
        }
        auto const plain = node.value<double>();
        if (!plain || node.is_boolean()) {
            fault(key, fmt::format("expects {}", name_of(dimension)),
                  {fmt::format("e.g. \"{}\"", example_of(dimension))});
            return none;
        }
        if (dimension == Dimension::one) return *plain;
        fault(key, fmt::format("needs a unit: expects {}", name_of(dimension)),
              {fmt::format("write it as text with its unit, e.g. \"{}\"", example_of(dimension))});
        return none;
    }

    void unknown_keys(toml::table const& table, std::string const& prefix);
    void unknown_key(std::string const& key, int line, toml::node const& node);
};

CaseFile::CaseFile(std::string path, std::string home) : inside_(std::make_unique<Inside>())
{
    inside_->path = std::move(path);
    inside_->home = home.empty() ? fs::path(inside_->path).parent_path().string() : std::move(home);
    inside_->text = read_case_text(inside_->path);
    inside_->root = parse(inside_->text, inside_->path);
}
CaseFile::~CaseFile() = default;

std::string const& CaseFile::path() const
{
    return inside_->path;
}
std::string const& CaseFile::text() const
{
    return inside_->text;
}
std::string CaseFile::beside(std::string const& name) const
{
    return (fs::path(inside_->home) / name).string();
}
void CaseFile::note_contents(std::string const& key, std::string const& path)
{
    derived(key + ".contents", fmt::format("hash {}", hash_text(hash_of(read_text(path)))),
            "of " + fs::path(path).filename().string());
}
bool CaseFile::has(std::string const& key) const
{
    return inside_->find(key) != nullptr;
}
bool CaseFile::says(std::string const& key, std::string const& text) const
{
    auto const* node = inside_->find(key);
    return node && node->is_string() && node->as_string()->get() == text;
}
bool CaseFile::wrong(std::string const& key) const
{
    return inside_->wrong.contains(key);
}
bool CaseFile::any_mistake() const
{
    return !inside_->mistakes.empty() || !inside_->missing.empty();
}
std::vector<Provenance> const& CaseFile::provenance() const
{
    return inside_->provenance;
}
std::vector<std::string> const& CaseFile::warnings() const
{
    return inside_->warnings;
}

int CaseFile::count(std::string const& key)
{
    inside_->known.insert(general(key));
    auto const* node = inside_->find(key);
    if (!node) return 0;
    if (auto const* array = node->as_array()) return static_cast<int>(array->size());
    inside_->fault(key, "expects a list of tables", {fmt::format("write [[{}]] above each", key)});
    return 0;
}

std::vector<std::string> CaseFile::names(std::string const& key)
{
    section(key);
    std::vector<std::string> out;
    auto const* node = inside_->find(key);
    if (!node || !node->is_table()) return out;
    for (auto const& [name, below] : *node->as_table()) {
        std::string const text(name.str());
        auto const full = key + "." + text;
        bool const plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
            return std::isalnum(c) || c == '-' || c == '_';
        });
        if (!plain)
            inside_->mistakes.push_back({inside_->path,
                                         static_cast<int>(name.source().begin.line),
                                         full,
                                         "is not a name",
                                         {"letters, digits, - and _ make a name"}});
        else if (!below.is_table())
            inside_->fault(full, "expects a section", {fmt::format("write [{}] on a line of its own", full)});
        else
            out.push_back(text);
        inside_->known.insert(full);
    }
    return out;
}

void CaseFile::section(std::string const& name)
{
    inside_->known.insert(name);
    inside_->sections.insert(name);
    auto const* node = inside_->find(name);
    if (node && !node->is_table())
        inside_->fault(name, "expects a section", {fmt::format("write [{}] on a line of its own", name)});
}

double CaseFile::quantity(std::string const& key, Dimension dimension, std::optional<double> fallback,
                          std::string const& doc, Range range)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) {
        if (!fallback) {
            inside_->absent(key, doc, fmt::format("\"{}\"", example_of(dimension)));
            return std::numeric_limits<double>::quiet_NaN();
        }
        inside_->note(key, write_quantity(*fallback, dimension), "default", doc);
        return *fallback;
    }
    double const value = inside_->number(*node, key, dimension);
    if (std::isfinite(value) &&
        (value < range.low || value > range.high || (value == range.low && !range.low_allowed))) {
        inside_->fault(key, "is out of range", {allowed(range, dimension)});
        return std::numeric_limits<double>::quiet_NaN();
    }
    inside_->note(key, write_quantity(value, dimension), origin, doc);
    return value;
}

std::optional<double> CaseFile::optional_quantity(std::string const& key, Dimension dimension, std::string const& doc,
                                                  Range range)
{
    std::string origin;
    if (!inside_->look(key, origin)) return std::nullopt;
    double const value = quantity(key, dimension, std::nullopt, doc, range);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

long CaseFile::integer(std::string const& key, std::optional<long> fallback, std::string const& doc, long low,
                       long high)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) {
        if (fallback)
            inside_->note(key, fmt::format("{}", *fallback), "default", doc);
        else
            inside_->absent(key, doc, "1");
        return fallback.value_or(low);
    }
    auto const* value = node->as_integer();
    if (!value || value->get() < low || value->get() > high) {
        inside_->fault(key, value ? "is out of range" : "expects a whole number",
                       {fmt::format("allowed: {} to {}", low, high)});
        return fallback.value_or(low);
    }
    inside_->note(key, fmt::format("{}", value->get()), origin, doc);
    return static_cast<long>(value->get());
}

bool CaseFile::boolean(std::string const& key, bool fallback, std::string const& doc)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) {
        inside_->note(key, fallback ? "true" : "false", "default", doc);
        return fallback;
    }
    auto const* value = node->as_boolean();
    if (!value) {
        inside_->fault(key, "expects true or false", {});
        return fallback;
    }
    inside_->note(key, value->get() ? "true" : "false", origin, doc);
    return value->get();
}

std::string CaseFile::words(std::string const& key, std::optional<std::string> fallback, std::string const& doc)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) {
        if (!fallback) inside_->absent(key, doc, "");
        if (fallback && !fallback->empty()) inside_->note(key, *fallback, "default", doc);
        return fallback.value_or("");
    }
    auto const* value = node->as_string();
    if (!value) {
        inside_->fault(key, "expects text in quotes", {});
        return fallback.value_or("");
    }
    inside_->note(key, value->get(), origin, doc);
    return value->get();
}

std::string CaseFile::name(std::string const& key, std::optional<std::string> fallback, std::string const& doc,
                           std::vector<std::string> const& choices, std::string const& kind)
{
    auto const value = words(key, fallback, doc);
    if (wrong(key) || std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
    std::vector<std::string> hints{"known: " + joined(choices)};
    if (auto const near = base::nearest_name(value, choices); !near.empty())
        hints.push_back(fmt::format("did you mean \"{}\"?", near));
    inside_->fault(key, fmt::format("is not {}", kind), hints);
    return fallback.value_or("");
}

math::Vec3 CaseFile::vector(std::string const& key, Dimension dimension, std::optional<math::Vec3> fallback,
                            std::string const& doc)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    auto const written = [&](math::Vec3 const& v) {
        return fmt::format("[{}, {}, {}]", write_quantity(v.x, dimension), write_quantity(v.y, dimension),
                           write_quantity(v.z, dimension));
    };
    auto const example = dimension == Dimension::one
                             ? std::string("[0, 0, -1]")
                             : fmt::format("[\"{0}\", \"{0}\", \"{0}\"]", example_of(dimension));
    if (!node) {
        if (fallback)
            inside_->note(key, written(*fallback), "default", doc);
        else
            inside_->absent(key, doc, example);
        return fallback.value_or(math::Vec3{});
    }
    auto const* array = node->as_array();
    if (!array || array->size() != 3) {
        inside_->fault(key, "expects three values, for x, y and z", {"e.g. " + example});
        return fallback.value_or(math::Vec3{});
    }
    math::Vec3 value;
    for (std::size_t i = 0; i < 3 && !wrong(key); ++i) value[i] = inside_->number(*array->get(i), key, dimension);
    if (wrong(key)) return fallback.value_or(math::Vec3{});
    inside_->note(key, written(value), origin, doc);
    return value;
}

std::vector<long> CaseFile::integers(std::string const& key, std::size_t length, std::string const& doc, long low,
                                     long high)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) return {};
    std::vector<long> out;
    auto const* array = node->as_array();
    bool good = array && array->size() == length;
    for (std::size_t i = 0; good && i < length; ++i) {
        auto const* value = array->get(i)->as_integer();
        good = value && value->get() >= low && value->get() <= high;
        if (good) out.push_back(static_cast<long>(value->get()));
    }
    if (!good) {
        inside_->fault(key, fmt::format("expects {} whole numbers", length),
                       {fmt::format("allowed: {} to {} each", low, high)});
        return {};
    }
    inside_->note(key, as_written(*node), origin, doc);
    return out;
}

std::vector<double> CaseFile::quantities(std::string const& key, Dimension dimension, std::string const& doc)
{
    std::string origin;
    auto const example =
        dimension == Dimension::one ? std::string("[1, 2]") : fmt::format("[\"{0}\", \"{0}\"]", example_of(dimension));
    auto const* node = inside_->look(key, origin);
    if (!node) {
        inside_->absent(key, doc, example);
        return {};
    }
    auto const* array = node->as_array();
    if (!array || array->empty()) {
        inside_->fault(key, "expects a list of values", {"e.g. " + example});
        return {};
    }
    std::vector<double> out;
    for (std::size_t i = 0; i < array->size() && !wrong(key); ++i)
        out.push_back(inside_->number(*array->get(i), key, dimension));
    if (wrong(key)) return {};
    inside_->note(key, as_written(*node), origin, doc);
    return out;
}

std::vector<std::vector<double>> CaseFile::table(std::string const& key, std::size_t width, Dimension dimension,
                                                 std::string const& doc)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) return {};
    std::vector<std::vector<double>> out;
    auto const* array = node->as_array();
    bool good = array && !array->empty();
    for (std::size_t i = 0; good && i < array->size(); ++i) {
        auto const* row = array->get(i)->as_array();
        good = row && row->size() == width;
        if (!good) break;
        out.emplace_back();
        for (std::size_t j = 0; j < width && !wrong(key); ++j)
            out.back().push_back(inside_->number(*row->get(j), key, dimension));
        if (wrong(key)) return {};
    }
    if (!good) {
        inside_->fault(key, fmt::format("expects a list of rows of {} values", width),
                       {fmt::format("e.g. [[\"{0}\", \"{0}\"], ...]", example_of(dimension))});
        return {};
    }
    inside_->note(key, as_written(*node), origin, doc);
    return out;
}

std::vector<std::string> CaseFile::list(std::string const& key, std::string const& doc,
                                        std::vector<std::string> const& choices)
{
    std::string origin;
    auto const* node = inside_->look(key, origin);
    if (!node) return {};
    std::vector<std::string> out;
    if (auto const* array = node->as_array())
        for (auto const& entry : *array)
            if (auto const* text = entry.as_string();
                text && std::find(choices.begin(), choices.end(), text->get()) != choices.end())
                out.push_back(text->get());
    if (!node->is_array() || out.size() != node->as_array()->size())
        inside_->fault(key, "expects a list of names", {"known: " + joined(choices)});
    else
        inside_->note(key, as_written(*node), origin, doc);
    return out;
}

void CaseFile::use_material(std::string const& section, std::string const& name, std::string const& file,
                            std::vector<std::string> const& left_out)
{
    auto values = parse(read_case_text(file), file);
    for (auto const& key : left_out) values.erase(key);
    inside_->materials[section] = {name, file, std::move(values)};
}

void CaseFile::know(std::string const& key)
{
    inside_->known.insert(general(key));
}

void CaseFile::mistake(std::string const& key, std::string const& what, std::vector<std::string> hints)
{
    inside_->fault(key, what, std::move(hints));
}

void CaseFile::derived(std::string const& key, std::string const& value, std::string const& doc)
{
    inside_->note(key, value, "derived", doc);
}

void CaseFile::Inside::unknown_key(std::string const& key, int line, toml::node const& node)
{
    auto const home = parent(general(key));
    auto const word = key.substr(parent(key).empty() ? 0 : parent(key).size() + 1);
    std::vector<std::string> siblings;
    for (auto const& name : known)
        if (parent(name) == home) siblings.push_back(name.substr(home.empty() ? 0 : home.size() + 1));
    if (home.empty())
        for (auto const& name : sections) siblings.push_back(name);
    std::sort(siblings.begin(), siblings.end());
    siblings.erase(std::unique(siblings.begin(), siblings.end()), siblings.end());
    auto near = base::nearest_name(word, siblings);
    std::vector<std::string> hints{"known: " + joined(siblings)};
    if (near.empty())  // the right word in the wrong section
        for (auto const& name : known)
            if (name.find("[]") == std::string::npos && name.size() > word.size() + 1 && name.ends_with("." + word))
                near = name;
    if (!near.empty()) {
        hints.push_back(fmt::format("did you mean \"{}\"?", near));
        auto const meant = parent(key).empty() ? near : parent(key) + "." + near;
        std::erase_if(missing,
                      [&](auto const& entry) { return entry.first == meant || entry.first.starts_with(meant + "."); });
    }
    bool const table = node.is_table() || node.is_array_of_tables();
    mistakes.push_back({path, line, table ? fmt::format("[{}]", key) : fmt::format("{} = {}", key, as_written(node)),
                        table ? "is not a section of a case" : "is not a known key", hints});
}

void CaseFile::Inside::unknown_keys(toml::table const& table, std::string const& prefix)
{
    auto const has_below = [this](std::string const& key) {
        return std::any_of(known.begin(), known.end(), [&](auto const& name) {
            return name.starts_with(key + ".") || name.starts_with(key + "[");
        });
    };
    for (auto const& [name, node] : table) {
        auto const key = prefix.empty() ? std::string(name.str()) : prefix + "." + std::string(name.str());
        int const line = static_cast<int>(name.source().begin.line);
        if (auto const* below = node.as_table(); below && has_below(general(key))) {
            unknown_keys(*below, key);
        } else if (auto const* array = node.as_array(); array && has_below(general(key))) {
            for (std::size_t i = 0; i < array->size(); ++i)
                if (auto const* entry = array->get(i)->as_table()) unknown_keys(*entry, fmt::format("{}[{}]", key, i));
        } else if (!known.contains(general(key))) {
            unknown_key(key, line, node);
        }
    }
}

void CaseFile::finish()
{
    inside_->unknown_keys(inside_->root, "");
    for (auto const& [material, values] : inside_->doubtful) {
        std::string list;
        for (auto const& value : values) list += (list.empty() ? "" : ", ") + value;
        inside_->warnings.push_back(fmt::format(
            "{}: {}: recalled values of low confidence; measure them, or set them in the case", material, list));
    }
    auto all = std::move(inside_->mistakes);
    for (auto& [key, mistake] : inside_->missing) all.push_back(std::move(mistake));
    if (all.empty()) return;
    std::stable_sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.line < b.line; });
    throw base::CaseError(std::move(all));
}
}
