#include "granum/io/csv.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace granum::io
{
namespace
{
std::vector<std::string_view> fields(std::string_view line)
{
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string_view> out;
    for (;;) {
        auto const comma = line.find(',');
        out.push_back(line.substr(0, comma));
        if (comma == std::string_view::npos) return out;
        line.remove_prefix(comma + 1);
    }
}
}

SeriesWriter::SeriesWriter(std::string const& path, std::vector<SeriesColumn> const& columns)
    : path_(path), width_(columns.size()), out_(path, std::ios::binary | std::ios::trunc)
{
    std::string names, units;
    for (auto const& column : columns) {
        std::string const comma = names.empty() ? "" : ",";
        names += comma + column.name;
        units += comma + column.unit;
    }
    out_ << names << '\n' << units << '\n' << std::flush;
    if (!out_) throw base::IoError(fmt::format("{}: cannot be written", path_));
}

void SeriesWriter::append(std::span<double const> row)
{
    base::require(row.size() == width_, "{}: a row of {} numbers for {} columns", path_, row.size(), width_);
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
        if (column > 0) line += ',';
        if (!std::isnan(row[column])) line += fmt::format("{}", row[column]);  // shortest text that reads back the same
    }
    out_ << line << '\n' << std::flush;
    if (!out_) throw base::IoError(fmt::format("{}: cannot be written; is the disk full?", path_));
}

std::vector<double> const* Series::find(std::string const& name) const
{
    for (std::size_t column = 0; column < columns.size(); ++column)
        if (columns[column].name == name) return &values[column];
    return nullptr;
}

Series read_series(std::string const& path)
{
    std::string const text = read_text(path);
    std::string_view rest = text;
    Series out;
    for (int line = 1;; ++line) {
        auto const end = rest.find('\n');
        if (end == std::string_view::npos) break;
        auto const row = fields(rest.substr(0, end));
        rest.remove_prefix(end + 1);
        if (line == 1) {
            for (auto const& name : row) out.columns.push_back({std::string(name), ""});
            out.values.resize(row.size());
            continue;
        }
        if (row.size() != out.columns.size())
            throw base::IoError(
                fmt::format("{}:{}: {} fields, expected {}", path, line, row.size(), out.columns.size()));
        for (std::size_t column = 0; column < row.size(); ++column) {
            if (line == 2) {
                out.columns[column].unit = row[column];
                continue;
            }
            double value = std::numeric_limits<double>::quiet_NaN();
            auto const [stop, failure] =
                std::from_chars(row[column].data(), row[column].data() + row[column].size(), value);
            if (!row[column].empty() && (failure != std::errc() || stop != row[column].data() + row[column].size()))
                throw base::IoError(fmt::format("{}:{}: \"{}\" is not a number", path, line, row[column]));
            out.values[column].push_back(value);
        }
    }
    return out;
}
}
