// The lab granulator of examples/01-lab-layering or of another liquid in it, reduced to what a test can afford:
// apparatus and recipe are the example's own lines, parcels and cells are fewer.
#pragma once

#include "scene/program.hpp"

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace granum::scene
{
//! Writes the reduced case to `path`. `changes` replaces values of the example by key; a key that the example has not
//! exactly once is a mistake of the test. `more` is appended.
inline void write_lab_case(std::string const& path, std::map<std::string, std::string> changes = {},
                           std::string const& more = "", std::string const& example = "01-lab-layering")
{
    changes.try_emplace("parcels", "3500");
    changes.try_emplace("cells", "[12, 12, 48]");
    std::ifstream in(GRANUM_SOURCE_DIR "/examples/" + example + "/case.toml");
    std::ofstream out(path);
    std::map<std::string, int> met;
    for (std::string line; std::getline(in, line);) {
        for (auto const& [key, value] : changes)
            if (line.starts_with(key + " = ")) {
                line = key + " = " + value;
                ++met[key];
                break;
            }
        out << line << "\n";
    }
    for (auto const& [key, value] : changes)
        if (met[key] != 1) throw std::runtime_error("the example does not have one line " + key + " = ...");
    out << more;
}
}
