#include "granum/sim/continuation.hpp"

#include "granum/base/error.hpp"
#include "granum/io/hash.hpp"
#include "granum/io/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace granum::sim
{
namespace fs = std::filesystem;

namespace
{
constexpr std::string_view file_word = "file = ", beside_word = "file from here = ";

//! The case file that a run was started from, as an absolute path and from the run folder.
struct Source
{
    std::string file, from_here;
};

bool shapes(std::string const& key)
{
    return key != "title" && key != "time.duration" && !key.starts_with("output.");
}

std::string record_of(std::string const& folder)
{
    return folder + "/checkpoint/case.txt";
}

std::map<std::string, std::string> by_key(std::string const& text)
{
    std::map<std::string, std::string> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (auto const equals = line.find(" = "); equals != std::string::npos)
            out[line.substr(0, equals)] = line.substr(equals + 3);
    return out;
}

Source source_of(std::string const& folder)
{
    Source out;
    std::istringstream lines(io::read_text(record_of(folder)));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(file_word)) out.file = line.substr(file_word.size());
        if (line.starts_with(beside_word)) out.from_here = line.substr(beside_word.size());
    }
    return out;
}

//! The case file of a source where it is now: a case and its run folder may have moved together.
std::string found(Source const& source, std::string const& folder)
{
    auto const moved = (fs::path(folder) / source.from_here).lexically_normal().string();
    return !fs::exists(source.file) && !source.from_here.empty() && fs::exists(moved) ? moved : source.file;
}

//! Granules that are given one by one are compared as a whole.
std::string given_hash(std::vector<GranuleCase> const& given)
{
    io::Hash hash;
    for (auto const& granule : given) {
        std::array const numbers{static_cast<double>(granule.id), static_cast<double>(granule.material), granule.count};
        hash.add(std::as_bytes(std::span(numbers)));
        for (auto const& vector :
             {granule.position, granule.velocity, granule.spin, math::Vec3{granule.diameter, granule.density, 0}})
            hash.add(std::as_bytes(std::span(&vector, 1)));
    }
    return io::hash_text(hash.digest());
}

nlohmann::json summary_of(std::string const& folder)
{
    auto const path = folder + "/summary.json";
    if (!fs::exists(path)) return {};
    return nlohmann::json::parse(io::read_text(path), nullptr, false);
}
}

std::string shaping_values(ResolvedCase const& resolved)
{
    std::string out;
    for (auto const& entry : resolved.origins)
        if (shapes(entry.key)) out += entry.key + " = " + entry.value + "\n";
    if (!resolved.data.granules.given.empty())
        out += fmt::format("granules given one by one = {} of hash {}\n", resolved.data.granules.given.size(),
                           given_hash(resolved.data.granules.given));
    return out;
}

std::uint64_t case_hash(ResolvedCase const& resolved)
{
    return io::hash_of(shaping_values(resolved));
}

void remember_case(std::string const& folder, ResolvedCase const& resolved)
{
    std::error_code there;
    fs::create_directories(folder + "/checkpoint", there);
    // A run that goes on from its own copy of the case still belongs to the file that it was started from.
    bool const copy = fs::exists(record_of(folder)) && fs::exists(folder + "/case.toml") &&
                      fs::equivalent(resolved.data.file, folder + "/case.toml");
    Source source;
    if (copy) {
        source = source_of(folder);
    } else {
        auto const file = fs::absolute(resolved.data.file).lexically_normal();
        source = {file.string(), file.lexically_relative(fs::absolute(folder).lexically_normal()).string()};
    }
    io::replace_text(
        record_of(folder),
        fmt::format("{}{}\n{}{}\n", file_word, source.file, beside_word, source.from_here) + shaping_values(resolved));
}

bool is_run_folder(std::string const& folder)
{
    return fs::exists(record_of(folder));
}

std::string case_file_of(std::string const& folder)
{
    auto const copy = folder + "/case.toml", original = found(source_of(folder), folder);
    bool const untouched =
        fs::exists(original) && (!fs::exists(copy) || io::read_text(original) == io::read_text(copy));
    return untouched ? original : copy;
}

std::string home_of(std::string const& path)
{
    auto const file = fs::path(path);
    auto const folder = file.parent_path().string();
    std::string const here = folder.empty() ? "." : folder;
    if (file.filename() != "case.toml" || !is_run_folder(here)) return folder;
    auto const original = found(source_of(here), here);
    bool const itself = fs::exists(original) && fs::exists(file) && fs::equivalent(original, file);
    return itself ? folder : home_of(original);  // a run may have been started from the copy of another
}

void refuse_other_case(std::string const& folder, ResolvedCase const& resolved)
{
    auto was = by_key(io::read_text(record_of(folder)));
    was.erase("file"), was.erase("file from here");
    auto const is = by_key(shaping_values(resolved));
    std::vector<std::string> hints;
    for (auto const& [key, value] : was) {
        auto const now = is.find(key);
        if (now == is.end())
            hints.push_back(fmt::format("{} was {}, is not there", key, value));
        else if (now->second != value)
            hints.push_back(fmt::format("{} was {}, is {}", key, value, now->second));
    }
    for (auto const& [key, value] : is)
        if (!was.contains(key)) hints.push_back(fmt::format("{} was not there, is {}", key, value));
    if (hints.empty()) return;
    hints.push_back(
        "to go on, only title, time.duration and [output] may change; --fresh discards the run and begins "
        "anew, -o names another folder");
    throw base::CaseError({{folder, 0, "", "is the run of another case", hints}});
}

bool is_done(std::string const& folder, double end)
{
    auto const summary = summary_of(folder);
    if (!summary.is_object() || summary.value("ended", "") != "done" || !summary.contains("run")) return false;
    return summary["run"].value("simulated_s", 0.0) >= end * (1 - 1e-12);
}

void mark_failed(std::string const& folder)
{
    auto summary = summary_of(folder);
    if (!summary.is_object() || summary.value("ended", "") != "running") return;
    summary["ended"] = "failed";
    io::replace_text(folder + "/summary.json", summary.dump(2) + "\n");
}
}
