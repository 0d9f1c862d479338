#include "granum/map/lab.hpp"

#include "granum/base/error.hpp"
#include "granum/io/case_file.hpp"
#include "granum/io/text_file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace granum::map
{
namespace
{
using io::Dimension;

//! Times and fluxes span decades.
bool logarithmic(std::string const& variable)
{
    return variable == "drying_time" || variable == "mean_flux" || variable == "max_flux";
}

std::vector<std::string> const orders{"free", "rising", "falling"};

nlohmann::ordered_json of(Eigen::VectorXd const& vector)
{
    return std::vector<double>(vector.begin(), vector.end());
}

Eigen::VectorXd vector_of(nlohmann::json const& json)
{
    auto const numbers = json.get<std::vector<double>>();
    return Eigen::Map<Eigen::VectorXd const>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

nlohmann::ordered_json of(Sums const& sums)
{
    return {{"solids", sums.solids},
            {"potential", sums.potential},
            {"first", of(sums.first)},
            {"second", of(sums.second)},
            {"nodes", of(sums.nodes)}};
}

Sums sums_of(nlohmann::json const& json)
{
    return {.solids = json.at("solids"),
            .nodes = vector_of(json.at("nodes")),
            .first = vector_of(json.at("first")),
            .second = vector_of(json.at("second")),
            .potential = json.at("potential")};
}
}

Lab read_lab(std::string const& path)
{
    io::CaseFile file(path);
    Lab lab;
    file.integer("format", 1, "version of the format of labs", 1, 1);
    lab.title = file.words("title", "", "for people");
    for (auto const* name : {"property", "map"}) file.section(name);
    lab.property = file.words("property.name", std::nullopt, "what was measured: porosity, roughness, strength ...");
    lab.unit = file.words("property.unit", "1", "of the measured values");
    lab.known.low = file.quantity("property.low", Dimension::one, lab.known.low, "that it can have", {});
    lab.known.high = file.quantity("property.high", Dimension::one, lab.known.high, "that it can have", {});
    if (lab.known.low >= lab.known.high) file.mistake("property.high", "is not above property.low");
    auto const order =
        file.name("property.order", "free", "how it changes along the first variable of the map", orders, "an order");
    lab.known.along_first = order == "rising"    ? Monotone::rising
                            : order == "falling" ? Monotone::falling
                                                 : Monotone::free;
    lab.variables = {"drying_time", "moisture_at_impact"};
    if (file.has("map.variables"))
        lab.variables =
            file.list("map.variables", "columns of the events that the property may depend on", event_variables());
    else
        file.know("map.variables");
    if (lab.variables.size() > 2 || (lab.variables.size() == 2 && lab.variables[0] == lab.variables[1]))
        file.mistake("map.variables", "must name one variable or two different ones");
    for (std::size_t a = 0; a < std::min<std::size_t>(lab.variables.size(), 2); ++a)
        lab.nodes.push_back(a == 0 ? 12 : 8);
    auto const names = Models::names();
    auto const model = file.name("map.model", names.front(), "to predict with", names, "a model of the map");
    std::erase(lab.wanted.models, model);
    lab.wanted.models.insert(lab.wanted.models.begin(), model);
    int const count = file.count("run");
    for (int k = 0; k < count; ++k) {
        auto const key = fmt::format("run[{}].", k);
        Lab::Run run;
        auto const folder = file.words(key + "folder", std::nullopt, "of the run");
        run.folder = file.beside(folder);
        if (!folder.empty() && !std::filesystem::is_regular_file(std::filesystem::path(run.folder) / "events.h5"))
            file.mistake(key + "folder", fmt::format("\"{}\" holds no events.h5", folder),
                         {"run the case first: granum run CASE -o " + folder});
        run.value = file.quantity(key + "value", Dimension::one, std::nullopt, "of the property, measured", {});
        run.error =
            file.quantity(key + "error", Dimension::one, std::nullopt, "standard error of the value", io::positive);
        if (run.value < lab.known.low || run.value > lab.known.high)
            file.mistake(key + "value", "is outside of what the property can have",
                         {fmt::format("property.low = {:.4g}, property.high = {:.4g}", lab.known.low, lab.known.high)});
        lab.runs.push_back(std::move(run));
    }
    if (count < 3)
        file.mistake("run", fmt::format("a map needs at least three runs, not {}", count),
                     {"add [[run]] tables with folder, value and error"});
    file.finish();
    return lab;
}

Map fit(Lab const& lab, std::vector<RunDeposits>* read)
{
    std::vector<RunDeposits> runs;
    for (auto const& run : lab.runs) runs.push_back(read_deposits(run.folder));
    Known known = lab.known;
    for (std::size_t a = 0; a < lab.variables.size(); ++a) {
        std::vector<double> all, solids;
        for (auto const& run : runs) {
            auto const& values = run.deposits.of(lab.variables[a]);
            all.insert(all.end(), values.begin(), values.end());
            solids.insert(solids.end(), run.deposits.solids.begin(), run.deposits.solids.end());
        }
        known.axes.axes.push_back(
            axis_over(lab.variables[a], logarithmic(lab.variables[a]), all, solids, lab.nodes[a]));
    }
    std::vector<LabRun> points;
    for (std::size_t k = 0; k < runs.size(); ++k)
        points.push_back({.name = std::filesystem::path(lab.runs[k].folder).filename().string(),
                          .value = lab.runs[k].value,
                          .error = lab.runs[k].error,
                          .potential = runs[k].potential,
                          .features = features(known.axes, runs[k].deposits)});
    if (read) *read = std::move(runs);
    return fit(lab.property, lab.unit, std::move(known), std::move(points), lab.wanted);
}

void write_map(Map const& map, Wanted const& wanted, std::string const& path)
{
    nlohmann::ordered_json out;
    out["format"] = 1;
    out["property"] = map.property;
    out["unit"] = map.unit;
    if (std::isfinite(map.known.low)) out["low"] = map.known.low;
    if (std::isfinite(map.known.high)) out["high"] = map.known.high;
    out["order"] = orders[static_cast<std::size_t>(map.known.along_first)];
    out["models"] = wanted.models;
    for (auto const& axis : map.known.axes.axes)
        out["axes"].push_back({{"variable", axis.variable},
                               {"logarithmic", axis.logarithmic},
                               {"low", axis.low},
                               {"high", axis.high},
                               {"nodes", axis.nodes}});
    for (auto const& run : map.runs) {
        auto& one = out["runs"].emplace_back();
        one = {{"name", run.name}, {"value", run.value}, {"error", run.error}, {"potential", run.potential}};
        for (auto const& block : run.features.blocks) one["blocks"].push_back(of(block));
    }
    io::replace_text(path, out.dump(1) + "\n");
}

Map read_map(std::string const& path, bool compare)
{
    auto const text = io::read_text(path);
    try {
        auto const in = nlohmann::json::parse(text);
        if (in.at("format") != 1)
            throw base::IoError(path + ": is a map of another format; this version reads format 1");
        Known known;
        known.low = in.value("low", known.low), known.high = in.value("high", known.high);
        auto const order = std::find(orders.begin(), orders.end(), in.at("order").get<std::string>());
        known.along_first = static_cast<Monotone>(order == orders.end() ? 0 : order - orders.begin());
        for (auto const& axis : in.at("axes"))
            known.axes.axes.push_back({.variable = axis.at("variable"),
                                       .logarithmic = axis.at("logarithmic"),
                                       .low = axis.at("low"),
                                       .high = axis.at("high"),
                                       .nodes = axis.at("nodes")});
        std::vector<LabRun> runs;
        for (auto const& one : in.at("runs")) {
            LabRun run{.name = one.at("name"),
                       .value = one.at("value"),
                       .error = one.at("error"),
                       .potential = one.at("potential")};
            for (auto const& block : one.at("blocks")) run.features.blocks.push_back(sums_of(block));
            runs.push_back(std::move(run));
        }
        return fit(in.at("property"), in.at("unit"), std::move(known), std::move(runs),
                   {.models = in.at("models"), .compare = compare});
    } catch (nlohmann::json::exception const& error) {
        throw base::IoError(fmt::format("{}: is not a map that granum map fit has written ({})", path, error.what()));
    }
}
}
