// Rows L: solids and water of every example with a spray, droplet by droplet, over its first moments as it stands: what
// the nozzles sprayed is on granules, on walls, in flight or gone with the gas.
#include "granum/io/summary_file.hpp"
#include "scene/program.hpp"
#include "scene/temporary_folder.hpp"
#include "verify/table.hpp"

#include <cmath>

namespace
{
using namespace granum;

struct Example
{
    char const *id, *path, *until;
};

class Ledger : public ::testing::TestWithParam<Example>
{
};

TEST_P(Ledger, of_solids_and_water_closes)
{
    auto const& example = GetParam();
    scene::TemporaryFolder const folder;
    auto const place = folder / "run";
    scene::Program program({"run", fmt::format("{}/examples/{}", GRANUM_SOURCE_DIR, example.path), "-n", "1", "-o",
                            place, "--until", example.until, "--quiet"},
                           folder / "said");
    ASSERT_EQ(program.wait(), 0) << program.errors();
    auto const summary = io::read_summary(place);
    auto const number = [&](std::string const& key) {
        auto const found = io::number_at(summary, key);
        EXPECT_TRUE(found) << key;
        return found.value_or(std::nan(""));
    };
    auto const name = std::string(example.path) + ", " + example.until + ", ";
    EXPECT_GT(number("spray.hits"), 100) << "nothing has happened yet";
    for (std::string const what : {"solids", "water"})
        verify::below(example.id, name + what + " that the ledger misses", 1e-9,
                      number("ledger." + what + ".relative_error"));
    double const sprayed = number("spray.sprayed_kg");
    double const found = number("spray.deposited_kg") + number("spray.overspray_kg") + number("spray.on_walls_kg") +
                         number("spray.in_flight_kg");
    verify::below(example.id, name + "solids sprayed that no droplet path has", 1e-9, found / sprayed - 1);
}

INSTANTIATE_TEST_SUITE_P(Examples, Ledger,
                         ::testing::Values(Example{"L1", "01-lab-layering/case.toml", "0.4 s"},
                                           Example{"L3", "03-scale-up/case-x8-1-nozzle.toml", "0.06 s"},
                                           Example{"L3", "03-scale-up/case-x8-2-nozzles.toml", "0.06 s"},
                                           Example{"L3", "03-scale-up/case-x8-4-nozzles.toml", "0.06 s"},
                                           Example{"L3", "03-scale-up/case-x8-8-nozzles.toml", "0.06 s"},
                                           Example{"L8", "08-wurster/case.toml", "0.1 s"},
                                           Example{"L9", "09-suspension/case.toml", "0.4 s"},
                                           Example{"L10", "10-melt/case.toml", "0.4 s"},
                                           Example{"L11", "11-pilot-x8/case.toml", "0.06 s"}));
}
