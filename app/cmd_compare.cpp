// granum compare RUN --with PLANT.csv: the curves of a real run laid over those of a simulated one.
#include "verbs.hpp"

#include "granum/study/compare.hpp"
#include "option_quantity.hpp"

#include <fmt/core.h>

namespace granum::app
{
void add_compare(CLI::App& program, Action& action)
{
    struct Wish
    {
        std::string folder, plant, shift;
    };
    auto* verb = program.add_subcommand("compare", "lay the curves of a real run over a simulated one");
    auto wish = std::make_shared<Wish>();
    verb->add_option("RUN", wish->folder, "run folder")->required();
    verb->add_option("--with", wish->plant, "CSV of the plant: time [min], outlet temperature [degC], ...")->required();
    verb->add_option("--shift", wish->shift, "time of the plant's log at which the run begins, e.g. \"20 min\" (0)");
    verb->callback([wish, &action] {
        action = [wish] {
            double const shift = wish->shift.empty() ? 0 : option_quantity("--shift", wish->shift, io::Dimension::time);
            auto const result = study::compare(wish->folder, wish->plant, shift);
            study::write(result);
            for (auto const& one : result.quantities)
                fmt::print("{:<20} run {}, plant {}, offset {} +- {}{}\n", one.name, study::shown(one.name, one.mean),
                           study::shown(one.name, one.plant_mean), study::shown(one.name, one.offset, true),
                           study::shown(one.name, one.error, true),
                           one.agrees    ? ""
                           : one.settled ? "  differs"
                                         : "  differs, not yet steady");
            for (auto const& cause : result.causes) fmt::print("- {}\n", cause);
            if (!result.left.empty()) fmt::print("not read: {}\n", result.not_read());
            fmt::print("beside the plant: {}/compare.csv, {}/compare.html\n", wish->folder, wish->folder);
            return 0;
        };
    });
}
}
