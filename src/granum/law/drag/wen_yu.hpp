// Drag in dilute suspensions: one sphere's drag times a power of the voidage.
#pragma once

#include "granum/law/drag/schiller_naumann.hpp"

namespace granum::law::drag
{
struct WenYu
{
    static constexpr base::Card card{.name = "wen-yu",
                                     .title = "Wen and Yu",
                                     .source = "Wen, Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100 (recalled)",
                                     .valid = "voidage above 0.8"};

    double operator()(Flow const& flow) const { return SchillerNaumann{}(flow)*std::pow(flow.eps(), -3.65); }
};
}
