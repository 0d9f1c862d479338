// Reads [apparatus].
#include "granum/sim/case_sections.hpp"

#include <algorithm>

namespace granum::sim
{
using io::Dimension;

void read_apparatus(io::CaseFile& file, Case& data, Purpose purpose)
{
    if (purpose == Purpose::balance && !file.has("apparatus")) return;
    auto const shape =
        file.name("apparatus.shape", std::nullopt, "\"box\", \"revolution\" (round, about the z axis) or \"solids\"",
                  {"box", "revolution", "solids"}, "a shape");
    bool const box = shape == "box";
    using Shape = geometry::Chamber::Shape;
    data.chamber.shape = shape == "solids" ? Shape::solids : box ? Shape::box : Shape::revolution;
    if (box || file.has("apparatus.size")) {
        data.chamber.size =
            file.vector("apparatus.size", Dimension::length, std::nullopt, "width, depth and height of a box");
        for (std::size_t i = 0; i < 3; ++i)
            if (!file.wrong("apparatus.size") && !(data.chamber.size[i] > 0))
                file.mistake("apparatus.size", "has a side that is not longer than 0");
        if (!box && !file.wrong("apparatus.shape")) file.mistake("apparatus.size", "belongs to shape = \"box\"");
    } else {
        file.know("apparatus.size");
    }
    for (auto const& axis :
         file.list("apparatus.periodic", "directions in which a box repeats itself", {"x", "y", "z"}))
        data.periodic[static_cast<std::size_t>(axis[0] - 'x')] = true;
    if (!box && (data.periodic[0] || data.periodic[1] || data.periodic[2]))
        file.mistake("apparatus.periodic", "belongs to shape = \"box\"");

    static std::vector<std::string> const faces{"left", "right", "front", "back", "bottom", "top"};
    for (auto const& name : file.list("apparatus.open", "faces without a wall: x = 0 is left, y = 0 front", faces)) {
        auto const face = static_cast<std::size_t>(std::find(faces.begin(), faces.end(), name) - faces.begin());
        data.open[face / 2][face % 2] = true;
        if (data.periodic[face / 2])
            file.mistake("apparatus.open", fmt::format("names {}, but {} repeats itself", name, "xyz"[face / 2]));
        if (shape == "revolution" && face < 4)
            file.mistake("apparatus.open", fmt::format("names {}, but the chamber is round", name));
    }
    data.discharge = file.name("apparatus.leaving", "error", "what a granule does that leaves through an open face",
                               {"error", "discharge"}, "a way to leave") == "discharge";
    if (file.has("apparatus.open") && file.has("gas"))
        file.mistake("apparatus.open", "goes with granules alone: gas has a plate and an outlet");
    if (file.has("apparatus.open") && shape == "solids")
        file.mistake("apparatus.open", "does not go with shape = \"solids\", which is closed to granules");

    auto const rows =
        file.table("apparatus.profile", 2, Dimension::length, "rows of height and diameter, from the plate up");
    if (shape != "revolution" && !rows.empty() && !file.wrong("apparatus.shape"))
        file.mistake("apparatus.profile", "belongs to shape = \"revolution\"");
    read_solids(file, data);
    if (shape != "revolution") return;
    if (!file.has("apparatus.profile"))
        file.mistake("apparatus.profile", "is missing",
                     {"rows of height and diameter, e.g. [[\"0 mm\", \"180 mm\"], [\"1 m\", \"180 mm\"]]"});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        bool const rises = i == 0 ? rows[0][0] == 0 : rows[i][0] > rows[i - 1][0];
        if (!rises) {
            file.mistake("apparatus.profile", "must begin at height 0 and rise from row to row");
            break;
        }
        if (!(rows[i][1] > 0)) {
            file.mistake("apparatus.profile", "has a diameter that is not above 0");
            break;
        }
        data.chamber.profile.push_back({rows[i][0], rows[i][1] / 2});
    }
    if (rows.size() == 1 && !file.wrong("apparatus.profile"))
        file.mistake("apparatus.profile", "needs at least two rows: the plate and the outlet");
}
}
