// The words at the end of a run say what is known and leave out what is not.
#include "granum/sim/summary.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace
{
using json = nlohmann::json;

json summary()
{
    json out{{"ended", "done"}};
    out["run"] = {{"simulated_s", 0.01}, {"wall_s", 2.0}, {"ranks", 1}};
    out["product"]["porosity"] = nullptr;
    out["balance"] = {{"eta", 0.7}, {"outlet_humidity", 0.01}, {"outlet_temperature_K", 330.0}};
    out["result"] = {{"eta_global", 0.71}, {"outlet_humidity", 0.0101}, {"outlet_temperature_K", 331.0}};
    out["bed"] = {{"pressure_drop_Pa", 300.25}, {"weight_over_area_Pa", 301.5}};
    for (auto const* ledger : {"solids", "water", "energy", "momentum"})
        out["ledger"][ledger]["relative_error"] = 1e-13;
    return out;
}

TEST(ClosingWords, tell_outlet_and_bed)
{
    auto const words = granum::sim::closing_words(summary().dump());
    EXPECT_NE(words.find("0.7100 (balance 0.7000)"), std::string::npos) << words;
    EXPECT_NE(words.find("301.5 Pa"), std::string::npos) << words;
}

TEST(ClosingWords, of_a_box_that_nothing_left_are_fewer)
{
    auto text = summary();
    for (auto const* key : {"eta_global", "outlet_humidity", "outlet_temperature_K"}) text["result"][key] = nullptr;
    text["bed"]["weight_over_area_Pa"] = nullptr;
    auto const words = granum::sim::closing_words(text.dump());
    EXPECT_EQ(words.find("drying potential"), std::string::npos) << words;
    EXPECT_EQ(words.find("weight"), std::string::npos) << words;
    EXPECT_NE(words.find("ledgers"), std::string::npos) << words;
}
}
