// Reads a size distribution: size = { distribution = "...", ... } in [granules] or a [[granules.batch]].
#include "granum/base/error.hpp"
#include "granum/io/csv.hpp"
#include "granum/sim/case_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace granum::sim
{
using io::Dimension;
using particle::SizeDistribution;
using particle::Weighting;

namespace
{
//! The CSV table of diameters (m) and cumulative shares.
std::optional<SizeDistribution> read_table(io::CaseFile& file, std::string const& key, Weighting weighting)
{
    auto const name = file.words(key, std::nullopt, "CSV file: diameter,cumulative with m,1 in its second line");
    if (file.wrong(key)) return std::nullopt;
    auto const fault = [&](std::string const& what) {
        file.mistake(key, what, {"first line diameter,cumulative, second line m,1, then rising rows from 0 to 1"});
        return std::nullopt;
    };
    io::Series series;
    try {
        series = io::read_series(file.beside(name));
        file.note_contents(key, file.beside(name));
    } catch (base::Error const& error) {
        return fault(error.what());
    }
    auto const* diameters = series.find("diameter");
    auto const* cumulative = series.find("cumulative");
    if (!diameters || !cumulative) return fault("has no columns diameter and cumulative");
    if (series.rows() < 2) return fault("has fewer than two rows");
    for (std::size_t row = 0; row < series.rows(); ++row) {
        double const d = (*diameters)[row], share = (*cumulative)[row];
        bool const rises = row == 0 || (d > (*diameters)[row - 1] && share >= (*cumulative)[row - 1]);
        if (!(d > 0) || !(share >= 0 && share <= 1) || !rises)
            return fault(fmt::format("line {}: diameter {} m, cumulative {} does not rise, or is out of range", row + 3,
                                     d, share));
    }
    if (cumulative->front() != 0 || cumulative->back() != 1) return fault("does not begin at 0 and end at 1");
    return SizeDistribution::table(*diameters, *cumulative, weighting);
}

std::optional<SizeDistribution> read_list(io::CaseFile& file, std::string const& key, Weighting weighting)
{
    auto const diameters = file.quantities(key + "diameters", Dimension::length, "of the classes");
    auto const shares = file.quantities(key + "shares", Dimension::one, "of the classes; need not sum to 1");
    if (file.wrong(key + "diameters") || file.wrong(key + "shares")) return std::nullopt;
    bool good = true;
    for (double const d : diameters) good = good && d > 0;
    if (!good) {
        file.mistake(key + "diameters", "has one that is not above 0");
        return std::nullopt;
    }
    double sum = 0;
    for (double const share : shares) good = good && share >= 0, sum += share;
    if (diameters.size() != shares.size() || !good || !(sum > 0)) {
        file.mistake(key + "shares", "must give each diameter its share, not below 0",
                     {fmt::format("there are {} diameters and {} shares", diameters.size(), shares.size())});
        return std::nullopt;
    }
    return SizeDistribution::list(diameters, shares, weighting);
}
}

std::optional<SizeDistribution> read_sizes(io::CaseFile& file, std::string const& prefix)
{
    auto const section = prefix + "size";
    file.section(section);
    if (!file.has(section) || file.wrong(section)) return std::nullopt;
    auto const key = section + ".";
    auto const kind =
        file.name(key + "distribution", std::nullopt, "how the diameters are spread",
                  {"list", "uniform", "normal", "log-normal", "rosin-rammler", "table"}, "a distribution");
    auto const by = file.name(key + "by", "mass", "what shares are shares of", {"mass", "number"}, "a measure");
    for (auto const* name : {"diameters", "shares", "file", "mean", "deviation", "median", "spread", "characteristic",
                             "exponent", "min", "max"})
        file.know(key + name);
    if (file.wrong(key + "distribution") || file.wrong(key + "by")) return std::nullopt;
    auto const weighting = by == "mass" ? Weighting::mass : Weighting::number;
    auto const only = [&](std::vector<std::string> const& used) {
        for (auto const* name : {"diameters", "shares", "file", "mean", "deviation", "median", "spread",
                                 "characteristic", "exponent", "min", "max"})
            if (file.has(key + name) && std::find(used.begin(), used.end(), name) == used.end())
                file.mistake(key + name, fmt::format("does not belong to a {} distribution", kind));
    };
    if (kind == "list") {
        only({"diameters", "shares"});
        return read_list(file, key, weighting);
    }
    if (kind == "table") {
        only({"file"});
        return read_table(file, key + "file", weighting);
    }
    auto const length = [&](char const* name, char const* doc) {
        return file.quantity(key + name, Dimension::length, std::nullopt, doc, io::positive);
    };
    double const low = length("min", "smallest diameter: what is finer is cut off");
    double const high = length("max", "largest diameter: what is coarser is cut off");
    if (low >= high) file.mistake(key + "max", "is not above min");
    bool const bounded = low < high;
    if (kind == "uniform") {
        only({"min", "max"});
        if (!bounded) return std::nullopt;
        return SizeDistribution::uniform(low, high, weighting);
    }
    double middle = 0, width = 0;
    char const* middle_name = kind == "normal" ? "mean" : kind == "log-normal" ? "median" : "characteristic";
    middle = length(middle_name, kind == "rosin-rammler" ? "diameter with 1 - 1/e finer" : "of the diameters");
    if (kind == "normal") {
        only({"min", "max", "mean", "deviation"});
        width = length("deviation", "standard deviation");
    } else if (kind == "log-normal") {
        only({"min", "max", "median", "spread"});
        width = file.quantity(key + "spread", Dimension::one, std::nullopt, "geometric standard deviation",
                              {.low = 1, .low_allowed = false});
    } else {
        only({"min", "max", "characteristic", "exponent"});
        width = file.quantity(key + "exponent", Dimension::one, std::nullopt, "the larger, the narrower", io::positive);
    }
    if (!bounded || !std::isfinite(middle + width)) return std::nullopt;
    try {
        if (kind == "normal") return SizeDistribution::normal(middle, width, low, high, weighting);
        if (kind == "log-normal") return SizeDistribution::log_normal(middle, width, low, high, weighting);
        return SizeDistribution::rosin_rammler(middle, width, low, high, weighting);
    } catch (base::NumericsError const&) {
        file.mistake(key + middle_name, "leaves no granules between min and max");
        return std::nullopt;
    }
}
}
