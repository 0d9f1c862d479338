#include "granum/report/run_folder.hpp"

#include "granum/base/error.hpp"
#include "granum/io/summary_file.hpp"
#include "granum/io/text_file.hpp"

#include <filesystem>
#include <sstream>

namespace granum::report
{
namespace
{
constexpr std::size_t most_warnings = 40;

//! Lines of the log that warn; the last of many.
std::vector<std::string> warnings_of(std::string const& log)
{
    std::vector<std::string> out;
    std::istringstream in(log);
    for (std::string line; std::getline(in, line);)
        if (line.find("warning") != std::string::npos) out.push_back(line);
    if (out.size() > most_warnings) out.erase(out.begin(), out.end() - most_warnings);
    return out;
}
}

nlohmann::json const& RunFolder::at(std::string_view key) const
{
    return io::at(summary, key);
}

std::optional<double> RunFolder::value(std::string_view key) const
{
    return io::number_at(summary, key);
}

std::string RunFolder::text(std::string_view key, std::string const& otherwise) const
{
    auto const& found = at(key);
    return found.is_string() ? found.get<std::string>() : otherwise;
}

std::vector<double> const* RunFolder::column(std::initializer_list<char const*> names) const
{
    for (auto const* name : names)
        if (auto const* found = series.find(name)) return found;
    return nullptr;
}

std::vector<std::size_t> RunFolder::event_rows() const
{
    std::vector<std::size_t> sprayed, all;
    auto const* initial = events.find("initial");
    for (std::size_t row = 0; row < events.rows(); ++row) {
        all.push_back(row);
        if (!initial || (*initial)[row] < 1) sprayed.push_back(row);
    }
    return sprayed.empty() ? all : sprayed;
}

std::vector<double> RunFolder::event_values(char const* name, std::vector<std::size_t> const& rows) const
{
    std::vector<double> out;
    if (auto const* found = events.find(name))
        for (auto const row : rows) out.push_back((*found)[row]);
    return out;
}

RunFolder read_run(std::string const& path)
{
    if (!std::filesystem::is_directory(path)) throw base::IoError(fmt::format("{}: is not a run folder", path));
    RunFolder run;
    run.path = path;
    auto attempt = [&](char const* file, auto&& read) {
        try {
            read((std::filesystem::path(path) / file).string());
        } catch (std::exception const& error) {
            run.missing.push_back(fmt::format("{}: {}", file, error.what()));
        }
    };
    attempt("summary.json", [&](std::string const&) { run.summary = io::read_summary(path); });
    attempt("timeseries.csv", [&](std::string const& file) { run.series = io::read_series(file); });
    // A case without a spray has no events to miss.
    if (run.summary.empty() || run.summary.contains("spray"))
        attempt("events.h5", [&](std::string const& file) { run.events = io::read_events(file); });
    attempt("snapshots.h5", [&](std::string const& file) { run.snapshot = io::read_snapshot(file); });
    attempt("resolved.txt", [&](std::string const& file) { run.resolved_case = io::read_text(file); });
    auto const& listed = run.at("warnings");
    if (listed.is_array()) {
        for (auto const& warning : listed)
            if (warning.is_string()) run.warnings.push_back(warning.get<std::string>());
    } else {
        attempt("granum.log", [&](std::string const& file) { run.warnings = warnings_of(io::read_text(file)); });
    }
    return run;
}
}
