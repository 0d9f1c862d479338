#include "granum/io/case_text.hpp"

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace granum::io
{
namespace fs = std::filesystem;

std::string as_written(toml::node const& node)
{
    std::string out;
    if (auto const* text = node.as_string()) {
        out = '"' + text->get() + '"';
    } else if (auto const* number = node.as_integer()) {
        out = fmt::format("{}", number->get());
    } else if (auto const* real = node.as_floating_point()) {
        out = fmt::format("{}", real->get());
    } else if (auto const* truth = node.as_boolean()) {
        out = truth->get() ? "true" : "false";
    } else if (auto const* array = node.as_array()) {
        for (auto const& entry : *array) out += (out.empty() ? "[" : ", ") + as_written(entry);
        out += out.empty() ? "[]" : "]";
    } else {
        out = "{...}";
    }
    return out.size() > 60 ? out.substr(0, 57) + "..." : out;
}

std::string general(std::string const& key)
{
    std::string out;
    bool inside = false;
    for (char const c : key) {
        if (c == ']') inside = false;
        if (!inside) out += c;
        if (c == '[') inside = true;
    }
    return out;
}

std::string parent(std::string const& key)
{
    auto const dot = key.rfind('.');
    return dot == std::string::npos ? "" : key.substr(0, dot);
}

std::string joined(std::vector<std::string> const& names)
{
    std::string out;
    for (auto const& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

std::string read_case_text(std::string const& path)
{
    std::error_code none;
    if (!fs::exists(path, none)) {
        auto const folder = fs::path(path).parent_path().empty() ? fs::path(".") : fs::path(path).parent_path();
        if (!fs::is_directory(folder, none))
            throw base::CaseError({{path, 0, "", fmt::format("there is no folder {}", folder.string()), {}}});
        std::vector<std::string> files;
        for (auto const& entry : fs::directory_iterator(folder, none))
            if (entry.path().extension() == ".toml") files.push_back(entry.path().filename().string());
        std::sort(files.begin(), files.end());
        auto const near = base::nearest_name(fs::path(path).filename().string(), files);
        std::vector<std::string> hints;
        if (files.size() > 8) files.resize(8);
        if (!files.empty()) hints.push_back("in that folder: " + joined(files));
        if (!near.empty()) hints.push_back(fmt::format("did you mean \"{}\"?", near));
        throw base::CaseError({{path, 0, "", "there is no such file", hints}});
    }
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    if (!in || fs::is_directory(path, none)) throw base::CaseError({{path, 0, "", "cannot be read as a file", {}}});
    return text.str();
}

toml::table parse(std::string const& text, std::string const& path)
{
    try {
        return toml::parse(text, path);
    } catch (toml::parse_error const& fault) {
        int const line = static_cast<int>(fault.source().begin.line);
        std::vector<std::string> hints;
        std::istringstream lines(text);
        std::string typed;
        for (int i = 0; i < line; ++i) std::getline(lines, typed);
        if (line > 0 && !typed.empty()) hints.push_back("the line: " + typed.substr(0, 80));
        auto const all = std::count(text.begin(), text.end(), '\n');
        if (line >= all) hints.push_back("the file ends here: is it complete?");
        throw base::CaseError(
            {{path, std::max(line, 1), "", fmt::format("cannot be read: {}", fault.description()), hints}});
    }
}

std::string allowed(Range const& range, Dimension dimension)
{
    auto const low = write_quantity(range.low, dimension), high = write_quantity(range.high, dimension);
    if (std::isfinite(range.low) && std::isfinite(range.high))
        return fmt::format("allowed: {}{} to {}", range.low_allowed ? "" : "above ", low, high);
    if (std::isfinite(range.low)) return fmt::format("allowed: {} {}", range.low_allowed ? "at least" : "above", low);
    return fmt::format("allowed: up to {}", high);
}
}
