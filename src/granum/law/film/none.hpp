// Granules between which the gas passes no heat.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/film/pair.hpp"

namespace granum::law::film
{
struct NoFilm
{
    static constexpr base::Card card{.name = "none", .title = "Left out", .source = "", .valid = "always"};

    double operator()(Pair const&) const { return 0; }
};
}
