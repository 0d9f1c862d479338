#include "granum/study/study.hpp"

#include "granum/base/error.hpp"
#include "granum/io/case_edit.hpp"
#include "granum/io/case_file.hpp"
#include "granum/io/folder_lock.hpp"
#include "granum/io/summary_file.hpp"
#include "granum/io/text_file.hpp"
#include "granum/sim/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace granum::study
{
namespace
{
namespace fs = std::filesystem;
using io::Dimension;

constexpr double first_look = 1.5;  // s beyond the window, for the start to die away

Outcome outcome_of(Point const& point, std::string const& folder)
{
    Outcome out{.point = point, .folder = folder};
    out.deposits = map::read_deposits(folder);
    auto const summary = io::read_summary(folder);
    auto const number = [&](char const* key) { return io::number_at(summary, key).value_or(std::nan("")); };
    out.simulated = number("run.simulated_s");
    out.wall = number("run.wall_s");
    out.eta = number("result.eta_global");
    out.outlet_temperature = number("result.outlet_temperature_K");
    out.outlet_humidity = number("result.outlet_humidity");
    out.balance_eta = number("balance.eta");
    out.balance_temperature = number("balance.outlet_temperature_K");
    out.balance_humidity = number("balance.outlet_humidity");
    out.solids_error = number("ledger.solids.relative_error");
    out.water_error = number("ledger.water.relative_error");
    return out;
}

Goal read_goal(io::CaseFile& file, std::string const& section, Goal goal)
{
    goal.least = file.quantity(section + "least", Dimension::time, goal.least,
                               "that the steady part of a run must last", io::positive);
    goal.most = file.quantity(section + "most", Dimension::time, goal.most, "that it may last", io::positive);
    goal.error = file.quantity(section + "error", Dimension::one, goal.error,
                               "standard error of the mean of log10 of the drying time that ends a run", io::positive);
    if (goal.most < goal.least) file.mistake(section + "most", fmt::format("is below {}least", section));
    return goal;
}
}

Study read_study(std::string const& path)
{
    io::CaseFile file(path);
    Study study{.path = path};
    file.integer("format", 1, "version of the format of studies", 1, 1);
    study.title = file.words("title", fs::path(path).stem().string(), "for people");
    file.section("window");
    study.goal = read_goal(file, "window.", study.goal);
    auto const map = file.words("map", "", "to predict the property of each point with");
    if (!map.empty()) study.map = file.beside(map);
    file.know("set");
    auto const common = file.words("case", "", "that all points are made of");
    int const count = file.count("point");
    std::set<std::string> names;
    for (int k = 0; k < count; ++k) {
        auto const key = fmt::format("point[{}].", k);
        Point point{.key = key + "set"};
        point.name = file.words(key + "name", std::nullopt, "of the point and of its run's folder");
        auto const own = file.words(key + "case", common, "that it is made of, instead of the study's");
        if (own.empty())
            file.mistake(key + "case", "is missing, and the study has no case of its own");
        else
            point.base = file.beside(own);
        file.know(key + "set");
        point.goal = read_goal(file, key + "window.", study.goal);
        bool const plain =
            !point.name.empty() && std::all_of(point.name.begin(), point.name.end(), [](unsigned char c) {
                return std::isalnum(c) || c == '-' || c == '_' || c == '.';
            });
        if (!plain && !file.wrong(key + "name"))
            file.mistake(key + "name", "is not a name of a folder", {"letters, digits, - . and _"});
        if (!names.insert(point.name).second) file.mistake(key + "name", "is there already");
        study.points.push_back(std::move(point));
    }
    study.reference = file.words("reference", "", "point that the others are compared with");
    if (!study.reference.empty() && !names.contains(study.reference))
        file.mistake("reference", "is none of the points");
    if (count == 0)
        file.mistake("point", "is missing: a study has points", {"add [[point]] tables with a name and what they set"});
    file.finish();
    return study;
}

std::string case_of(Study const& study, Point const& point)
{
    io::CaseEdit edit(point.base);
    edit.merge(study.path, "set");
    edit.merge(study.path, point.key);
    return edit.text(fmt::format("Point {} of {}, made by granum study from {}.", point.name,
                                 fs::path(study.path).filename().string(), fs::path(point.base).filename().string()));
}

std::optional<double> next_end(Goal const& goal, map::Window const& window)
{
    double const length = window.to - window.from;
    if (window.settled && length >= goal.least && window.error <= goal.error) return std::nullopt;
    if (window.settled && length >= goal.most) return std::nullopt;
    double wanted = goal.least;
    // Errors fall with the root of the length; a tenth more, so that the next look is the last.
    if (window.settled && window.error > goal.error)
        wanted = std::max(wanted, 1.1 * length * std::pow(window.error / goal.error, 2));
    // One that has not settled is given its length again.
    double const end =
        window.settled ? window.from + std::min(wanted, goal.most) : window.to + std::max(goal.least, length);
    if (!window.settled && window.to > 2 * goal.most) return std::nullopt;
    return std::max(end, window.to + 0.2 * goal.least);
}

namespace
{
//! How far the run in a folder has come, s; 0 where there is none.
double simulated(std::string const& place)
{
    if (!fs::exists(fs::path(place) / "summary.json") || !fs::exists(fs::path(place) / "events.h5")) return 0;
    return io::number_at(io::read_summary(place), "run.simulated_s").value_or(0);
}

//! The right to work at a point, or nothing where another process has it.
std::unique_ptr<io::FolderLock> claimed(std::string const& folder, Point const& point)
{
    auto const place = fs::path(folder) / "cases" / "claims" / point.name;
    fs::create_directories(place);
    try {
        return std::make_unique<io::FolderLock>(place.string(), 0);
    } catch (base::IoError const&) {
        return nullptr;
    }
}
}

std::vector<std::string> write_cases(Study const& study, std::string const& folder)
{
    fs::create_directories(fs::path(folder) / "cases");
    std::vector<std::string> files;
    for (auto const& point : study.points) {
        files.push_back((fs::path(folder) / "cases" / (point.name + ".toml")).string());
        auto const text = case_of(study, point);
        // Others may be reading them.
        if (!fs::exists(files.back()) || io::read_text(files.back()) != text) io::replace_text(files.back(), text);
        sim::read_case(files.back());
    }
    return files;
}

Campaign run(Study const& study, std::string const& folder, Runner const& runner,
             std::function<void(std::string const&)> const& said)
{
    auto const files = write_cases(study, folder);
    Campaign out;
    for (std::size_t k = 0; k < study.points.size(); ++k) {
        auto const& point = study.points[k];
        auto const claim = claimed(folder, point);
        if (!claim) continue;
        auto const place = (fs::path(folder) / point.name).string();
        // A run that was stopped early has its first goal before it.
        std::optional<double> until = point.goal.least + first_look;
        if (simulated(place) >= *until * (1 - 1e-6)) until = next_end(point.goal, map::read_deposits(place).window);
        while (until) {
            said(fmt::format("{}: to {:.3g} s", point.name, *until));
            int const status = runner(files[k], place, *until);
            if (status == 130) {
                out.stopped = true;
                return out;
            }
            if (status != 0) throw base::NumericsError(fmt::format("{}: granum run ended with {}", place, status));
            until = next_end(point.goal, map::read_deposits(place).window);
        }
        auto& outcome = out.outcomes.emplace_back(outcome_of(point, place));
        auto const& window = outcome.deposits.window;
        outcome.enough =
            window.settled && window.error <= point.goal.error && window.to - window.from >= point.goal.least;
        said(fmt::format("{}: {:.3g} to {:.3g} s, log10 of the drying time {:.4f} +- {:.4f}{}", point.name, window.from,
                         window.to, window.mean, window.error, outcome.enough ? "" : " (NOT as good as asked)"));
    }
    return out;
}
}
