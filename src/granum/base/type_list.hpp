// A family of laws is a list of types: one name in the list feeds the case reader, `granum list`, the manual
// and the tests over all laws of the family.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace granum::base
{
//! What a law says about itself.
struct Card
{
    std::string_view name;    //!< as written in a case
    std::string_view title;   //!< for people
    std::string_view source;  //!< paper or book, with an evidence mark where it is recalled
    std::string_view valid;   //!< range, in words
};

//! Compile-time list of law types, each with a static `card`.
template <class... Laws>
struct TypeList
{
    using Any = std::variant<Laws...>;
    static constexpr std::size_t size = sizeof...(Laws);
    static constexpr std::array<Card, size> cards{Laws::card...};

    //! The law called `name`, default constructed; empty if there is none.
    static std::optional<Any> make(std::string_view name)
    {
        std::optional<Any> found;
        ((Laws::card.name == name ? void(found = Any{Laws{}}) : void()), ...);
        return found;
    }

    static std::vector<std::string> names()
    {
        std::vector<std::string> out;
        for (auto const& card : cards) out.emplace_back(card.name);
        return out;
    }
};

//! Card of the law held by a variant.
template <class Any>
Card card_of(Any const& any)
{
    return std::visit([](auto const& law) { return std::decay_t<decltype(law)>::card; }, any);
}

//! The known name nearest to what was typed (edit distance up to a third of its length), or empty.
std::string nearest_name(std::string_view typed, std::vector<std::string> const& known);
}
