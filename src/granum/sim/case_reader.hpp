// From a case file to a resolved case: every key that a case may have, its default, its range and what it means.
#pragma once

#include "granum/sim/case.hpp"

#include <string>

namespace granum::sim
{
//! What the case is read for: a balance needs only [gas] and [spray].
enum class Purpose
{
    run,
    balance
};

//! Reads, resolves and checks the case at `path`. Throws base::CaseError with every mistake found.
ResolvedCase read_case(std::string const& path, Purpose purpose = Purpose::run);

//! Every value of the case with its origin, one per line, for people.
std::string explain(ResolvedCase const& resolved);
}
