// granum scale CASE: cases of a pilot plant that dries as the lab does, one for each number of nozzles.
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"
#include "granum/sim/scale.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace granum::app
{
void add_scale(CLI::App& program, Action& action)
{
    struct Wish
    {
        std::string path, folder = ".", alike = "height";
        double factor = 8;
        std::vector<int> nozzles{1};
    };
    auto* verb = program.add_subcommand("scale", "cases of a pilot plant with the lab's velocity and drying potential");
    auto wish = std::make_shared<Wish>();
    verb->add_option("CASE", wish->path, "case of the lab")->required();
    verb->add_option("--factor", wish->factor, "mass of granules over that of the lab (8)");
    verb->add_option("--nozzles", wish->nozzles, "that share the spray: one case for each number, e.g. 1,2,4,8")
        ->delimiter(',');
    verb->add_option("--alike", wish->alike,
                     "height: plate area by the factor, heights as they are; geometry: all lengths alike")
        ->check(CLI::IsMember({"height", "geometry"}));
    verb->add_option("-o,--output", wish->folder, "folder for the cases (here)");
    verb->callback([wish, &action] {
        action = [wish] {
            namespace fs = std::filesystem;
            std::vector<std::pair<fs::path, std::string>> cases;
            for (int const nozzles : wish->nozzles) {
                auto const likeness = wish->alike == "height" ? sim::Likeness::height : sim::Likeness::geometry;
                auto const file = fs::path(wish->folder) / fmt::format("{}-x{:g}-{}-nozzle{}.toml",
                                                                       fs::path(wish->path).stem().string(),
                                                                       wish->factor, nozzles, nozzles == 1 ? "" : "s");
                if (fs::exists(file))
                    throw base::CaseError(
                        {{file.string(), 0, "", "exists already", {"choose another folder with -o"}}});
                cases.emplace_back(file, sim::scaled_case(wish->path, {wish->factor, nozzles, likeness}));
            }
            fs::create_directories(wish->folder);
            for (auto const& [file, text] : cases) {
                io::replace_text(file.string(), text);
                fmt::print("wrote {}\n", file.string());
            }
            return 0;
        };
    });
}
}
