#include "granum/io/logged.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace granum::io
{
namespace
{
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text)
{
    auto const blank = [](char c) { return c == ' ' || c == '\r' || c == '\t' || c == '"'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> split(std::string_view line, char mark)
{
    std::vector<std::string_view> out;
    for (;;) {
        auto const at = line.find(mark);
        out.push_back(trimmed(line.substr(0, at)));
        if (at == std::string_view::npos) return out;
        line.remove_prefix(at + 1);
    }
}

//! "Exhaust temperature" as "exhaust_temperature".
std::string as_name(std::string_view words)
{
    std::string out;
    for (char const c : trimmed(words)) {
        bool const letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (letter)
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    while (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}

struct Column
{
    std::string name, unit;
};

//! Name and unit of "exhaust temperature [degC]".
Column column_of(std::string_view head)
{
    for (auto const& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        auto const from = head.rfind(open), to = head.rfind(close);
        if (from != std::string_view::npos && to != std::string_view::npos && from < to)
            return {as_name(head.substr(0, from)), std::string(trimmed(head.substr(from + 1, to - from - 1)))};
    }
    return {as_name(head), ""};
}

//! A degree sign is for people.
std::string plain_unit(std::string unit)
{
    for (std::string const sign : {"\xc2\xb0", "\xc2\xba"})
        if (auto const at = unit.find(sign); at != std::string::npos) unit.replace(at, sign.size(), "deg");
    return unit;
}

bool is_number(std::string_view field)
{
    return !field.empty() && (std::isdigit(static_cast<unsigned char>(field[0])) != 0 || field[0] == '-' ||
                              field[0] == '+' || field[0] == '.');
}

class Reader
{
  public:
    Reader(std::string const& path, std::map<std::string, Dimension> const& known) : path_(path), known_(known) {}

    Series read(std::vector<std::string>& left)
    {
        std::string const text = read_text(path_);
        std::string_view rest = text;
        if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
        while (!rest.empty()) {
            auto const end = rest.find('\n');
            ++line_;
            auto const line = rest.substr(0, end);
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
            if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
            if (columns_.empty())
                head(line);
            else
                row(line);
        }
        if (columns_.empty()) wrong("", "holds no table", {"its first row names the columns: time [min], ..."});
        Series out;
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            if (known_.find(columns_[k].name) == known_.end()) {
                left.push_back(columns_[k].name);
                continue;
            }
            if (out.find(columns_[k].name) != nullptr) {
                line_ = head_line_;
                wrong(columns_[k].name, "is there twice");
            }
            out.columns.push_back({columns_[k].name, "SI"});
            out.values.push_back(std::move(values_[k]));
        }
        return out;
    }

  private:
    [[noreturn]] void wrong(std::string const& key, std::string const& what, std::vector<std::string> hints = {}) const
    {
        throw base::CaseError({{path_, line_, key, what, std::move(hints)}});
    }

    void head(std::string_view line)
    {
        head_line_ = line_;
        mark_ = line.find(';') != std::string_view::npos ? ';' : line.find('\t') != std::string_view::npos ? '\t' : ',';
        for (auto const field : split(line, mark_)) columns_.push_back(column_of(field));
        values_.resize(columns_.size());
    }

    void row(std::string_view line)
    {
        auto const fields = split(line, mark_);
        if (fields.size() != columns_.size())
            wrong("", fmt::format("has {} fields, the first row {}", fields.size(), columns_.size()),
                  {fmt::format("fields are divided by '{}' there", mark_ == '\t' ? "tab" : std::string(1, mark_))});
        bool const units =
            values_[0].empty() &&
            std::none_of(columns_.begin(), columns_.end(), [](auto& c) { return !c.unit.empty(); }) &&
            std::all_of(fields.begin(), fields.end(), [](auto f) { return f == "1" || !is_number(f); }) &&
            std::any_of(fields.begin(), fields.end(), [](auto f) { return f != "1" && !f.empty(); });
        for (std::size_t k = 0; k < fields.size(); ++k) {
            if (units)
                columns_[k].unit = std::string(fields[k]);
            else if (auto const found = known_.find(columns_[k].name); found != known_.end())
                values_[k].push_back(value(fields[k], columns_[k], found->second));
            else
                values_[k].push_back(nothing);
        }
    }

    double value(std::string_view field, Column const& column, Dimension dimension) const
    {
        if (field.empty()) return nothing;
        std::string text(field);
        if (mark_ != ',') std::replace(text.begin(), text.end(), ',', '.');
        double number = 0;
        auto const* const from = text.data() + (text[0] == '+');
        auto const read = std::from_chars(from, text.data() + text.size(), number);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size())
            wrong(column.name, fmt::format("is \"{}\": not a number", field),
                  {"an empty field stands for no value", "times count from a start: seconds, minutes or hours"});
        if (column.unit.empty() && dimension != Dimension::one)
            wrong(column.name, fmt::format("needs its unit: {}", name_of(dimension)),
                  {fmt::format("in the first row, as \"{} [{}]\"", column.name, unit_of(example_of(dimension)))});
        try {
            return read_quantity(column.unit.empty() || column.unit == "1"
                                     ? fmt::format("{}", number)
                                     : fmt::format("{} {}", number, plain_unit(column.unit)),
                                 dimension);
        } catch (QuantityError const& error) {
            wrong(column.name, fmt::format("in [{}] {}", column.unit, error.what()), {error.hint});
        }
    }

    //! "mm" of "0.6 mm".
    static std::string unit_of(std::string_view example)
    {
        auto const blank = example.find(' ');
        return blank == std::string_view::npos ? std::string("1") : std::string(example.substr(blank + 1));
    }

    std::string path_;
    std::map<std::string, Dimension> const& known_;
    int line_ = 0, head_line_ = 0;
    char mark_ = ',';
    std::vector<Column> columns_;
    std::vector<std::vector<double>> values_;
};
}

Series read_logged(std::string const& path, std::map<std::string, Dimension> const& known,
                   std::vector<std::string>& left)
{
    return Reader(path, known).read(left);
}
}
