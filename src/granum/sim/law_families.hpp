// Every family of laws with its cards: what `granum list` shows and, where the family has a key, what a case may name.
#pragma once

#include "granum/base/type_list.hpp"

#include <string>
#include <vector>

namespace granum::sim
{
struct LawFamily
{
    std::string name;  //!< as `granum list` takes it
    std::string key;   //!< of the case that chooses the law; empty where no case chooses it yet
    std::string title;
    std::vector<base::Card> cards;

    std::vector<std::string> names() const;
};

std::vector<LawFamily> const& law_families();

//! The names that the case key `key` may have, e.g. "gas.drag". Throws std::out_of_range for a key of no family.
std::vector<std::string> laws_for(std::string const& key);
}
