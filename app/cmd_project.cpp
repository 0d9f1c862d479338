// granum project RUN: from the seconds of a run to the hours of its batch.
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/study/projection.hpp"
#include "option_quantity.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace granum::app
{
void add_project(CLI::App& program, Action& action)
{
    struct Wish
    {
        std::string folder, feed, discharge, nuclei, agglomeration;
        double hours = 1, sharpness = 20, kept = 1;
    };
    auto* verb = program.add_subcommand("project", "size and layer after hours, from the rates of a run");
    auto wish = std::make_shared<Wish>();
    verb->add_option("RUN", wish->folder, "run folder")->required();
    verb->add_option("--hours", wish->hours, "to project (1)")->check(CLI::Range(1e-3, 1e4));
    auto* feed =
        verb->add_option("--feed", wish->feed, "cores that are fed, e.g. \"0.5 kg/h\": the bed is kept at its volume");
    verb->add_option("--discharge", wish->discharge, "size that is let through, e.g. \"0.8 mm\"; with --feed")
        ->needs(feed);
    verb->add_option("--sharpness", wish->sharpness, "of the discharge (20)")->check(CLI::Range(1.0, 1000.0));
    auto* nuclei =
        verb->add_option("--nuclei", wish->nuclei, "size that dust of the spray has when it stays as new granules");
    verb->add_option("--kept", wish->kept, "share of the dust that stays (1); with --nuclei")
        ->check(CLI::Range(0.0, 1.0))
        ->needs(nuclei);
    verb->add_option("--agglomeration", wish->agglomeration,
                     "share of the granules that join others at the beginning, e.g. \"2 %/h\"; any pair alike");
    verb->callback([wish, &action] {
        action = [wish] {
            if (!std::filesystem::is_directory(wish->folder))
                throw base::CaseError({{wish->folder, 0, "", "there is no such run folder", {}}});
            std::optional<study::Continuous> continuous;
            if (!wish->feed.empty()) {
                if (wish->discharge.empty())
                    throw base::CaseError({{"",
                                            0,
                                            "--feed",
                                            "needs --discharge: what leaves a bed that is fed",
                                            {"e.g. --discharge \"0.8 mm\""}}});
                continuous = study::Continuous{option_quantity("--feed", wish->feed, io::Dimension::mass_flow),
                                               option_quantity("--discharge", wish->discharge, io::Dimension::length),
                                               wish->sharpness};
            }
            study::Besides besides;
            if (!wish->nuclei.empty())
                besides.nuclei = {wish->kept, option_quantity("--nuclei", wish->nuclei, io::Dimension::length)};
            if (!wish->agglomeration.empty())
                besides.agglomeration =
                    option_quantity("--agglomeration", wish->agglomeration, io::Dimension::count_rate);
            auto const result = study::project(wish->folder, wish->hours, continuous, besides);
            study::write(result, wish->folder);
            auto const& end = result.rows.back();
            fmt::print(
                "after {:.3g} h: d10 {:.1f} um, d50 {:.1f} um ({:.1f} to {:.1f} with the porosity's interval), d90 "
                "{:.1f} um\n",
                wish->hours, 1e6 * end.d10, 1e6 * end.d50, 1e6 * end.d50_low, 1e6 * end.d50_high, 1e6 * end.d90);
            fmt::print("projection: {}/project.csv, {}/project.html\n", wish->folder, wish->folder);
            return 0;
        };
    });
}
}
