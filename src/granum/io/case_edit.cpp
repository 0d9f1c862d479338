#include "granum/io/case_edit.hpp"

#include "granum/base/error.hpp"
#include "granum/io/case_text.hpp"

#include <charconv>
#include <sstream>

namespace granum::io
{
struct CaseEdit::Inside
{
    std::string path;
    toml::table table;

    [[noreturn]] void wrong(std::string const& key, std::string const& what) const
    {
        throw base::CaseError({{path, 0, key, what, {}}});
    }

    //! The table that holds the last part of `key`, and that part. Missing sections are made where `make`.
    std::pair<toml::table*, std::string> place(std::string const& key, bool make)
    {
        toml::table* here = &table;
        std::size_t from = 0;
        for (std::size_t dot; (dot = key.find('.', from)) != std::string::npos; from = dot + 1) {
            auto part = key.substr(from, dot - from);
            std::size_t number = 0;
            bool const of_array = part.back() == ']';
            if (of_array) {
                number = std::stoul(part.substr(part.find('[') + 1));
                part.resize(part.find('['));
            }
            toml::node* next = here->get(part);
            if (of_array) {
                auto* const array = next ? next->as_array() : nullptr;
                next = array && number < array->size() ? array->get(number) : nullptr;
            } else if (!next && make) {
                next = &here->insert(part, toml::table{}).first->second;
            }
            here = next ? next->as_table() : nullptr;
            if (!here) return {nullptr, ""};
        }
        return {here, key.substr(from)};
    }
};

CaseEdit::CaseEdit(std::string const& path) : inside_(new Inside{path, parse(read_case_text(path), path)}) {}
CaseEdit::~CaseEdit() = default;

bool CaseEdit::has(std::string const& key) const
{
    auto const [table, name] = inside_->place(key, false);
    return table && table->contains(name);
}

void CaseEdit::set(std::string const& key, std::string const& value)
{
    auto const [table, name] = inside_->place(key, true);
    if (!table) inside_->wrong(key, "is no place in this case");
    toml::table parsed;
    try {
        parsed = toml::parse("x = " + value);
    } catch (toml::parse_error const& error) {
        inside_->wrong(key, fmt::format("cannot be set to {}: {}", value, error.description()));
    }
    table->insert_or_assign(name, *parsed.get("x"));
}

void CaseEdit::remove(std::string const& key)
{
    auto const [table, name] = inside_->place(key, false);
    if (table) table->erase(name);
}

void CaseEdit::repeat(std::string const& name, int count)
{
    auto* const array = inside_->table.get_as<toml::array>(name);
    if (!array || array->empty()) inside_->wrong(name, "is missing: there is none to repeat");
    array->resize(1, 0);
    for (int k = 1; k < count; ++k) array->push_back(*array->get(0)->as_table());
}

namespace
{
void merge_into(toml::table& to, toml::table const& from)
{
    for (auto const& [name, node] : from) {
        auto* const old = to.get_as<toml::table>(name.str());
        if (auto const* below = node.as_table(); below && old)
            merge_into(*old, *below);
        else
            to.insert_or_assign(name.str(), node);
    }
}
}

void CaseEdit::merge(std::string const& path, std::string const& key)
{
    Inside other{path, parse(read_case_text(path), path)};
    auto const [table, name] = other.place(key, false);
    auto const* found = table ? table->get_as<toml::table>(name) : nullptr;
    if (found) merge_into(inside_->table, *found);
}

namespace
{
//! Numbers as short as they read back the same: 0.8 instead of 0.80000000000000004. Texts stay as they are.
std::string shortened(std::string const& text)
{
    std::string out;
    char quote = 0;
    for (std::size_t at = 0; at < text.size();) {
        char const c = text[at];
        if (quote != 0 || c == '\'' || c == '"') {
            quote = quote == 0 ? c : c == quote ? 0 : quote;
            out += c, ++at;
            continue;
        }
        auto const end = text.find_first_not_of("0123456789.e+-", at);
        auto const number = text.substr(at, end == std::string::npos ? end : end - at);
        double value = 0;
        auto const read = std::from_chars(number.data(), number.data() + number.size(), value);
        bool const whole = number.empty() || number.find('.') == std::string::npos || read.ec != std::errc() ||
                           read.ptr != number.data() + number.size();
        if (number.empty()) {
            out += c, ++at;
            continue;
        }
        auto const brief = fmt::format("{}", value);  // "1" would be an integer
        out += whole ? number : brief.find_first_of(".e") == std::string::npos ? brief + ".0" : brief;
        at += number.size();
    }
    return out;
}
}

std::string CaseEdit::text(std::string const& remark) const
{
    std::ostringstream out;
    out << toml::toml_formatter(inside_->table) << "\n";
    return "# " + remark + "\n" + shortened(out.str());
}
}
