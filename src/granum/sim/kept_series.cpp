#include "granum/sim/kept_series.hpp"

#include <algorithm>

namespace granum::sim
{
KeptSeries::KeptSeries(std::string const& path, std::string kind, std::vector<io::SeriesColumn> columns)
    : kind_(std::move(kind)), columns_(std::move(columns)), file_(std::make_unique<io::SeriesWriter>(path, columns_))
{
}

void KeptSeries::append(std::span<double const> row)
{
    file_->append(row);
    values_.insert(values_.end(), row.begin(), row.end());
}

std::span<double const> KeptSeries::row(std::size_t number) const
{
    return std::span(values_).subspan(number * columns_.size(), columns_.size());
}

std::string KeptSeries::head() const
{
    std::string out;
    for (auto const& column : columns_) out += column.name + "\n";
    return out;
}

void KeptSeries::save(io::Sections& out) const
{
    if (!writes()) return;
    auto const text = head();
    out.push_back(io::section_of("output." + kind_ + ".head", std::vector<char>(text.begin(), text.end())));
    out.push_back(io::section_of("output." + kind_, values_));
}

void KeptSeries::go_on(io::Sections const& saved)
{
    auto const name = "output." + kind_;
    bool const kept = std::any_of(saved.begin(), saved.end(), [&](auto const& one) { return one.name == name; });
    if (!writes() || !kept) return;
    auto const was = io::values_of<char>(io::find_section(saved, name + ".head"));
    if (std::string(was.begin(), was.end()) != head()) return;
    auto const values = io::values_of<double>(io::find_section(saved, name));
    for (std::size_t at = 0; at + columns_.size() <= values.size(); at += columns_.size())
        append(std::span<double const>(values).subspan(at, columns_.size()));
}
}
