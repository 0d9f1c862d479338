// What belongs to a granule without being a column: contact history, open deposits. It travels with the granule.
#pragma once

#include "granum/particle/store.hpp"

#include <span>

namespace granum::particle
{
class Attachment
{
  public:
    virtual ~Attachment() = default;
    //! Appends all that belongs to granule `id` to `bytes` and forgets it here.
    virtual void take(Id id, std::vector<std::byte>& bytes) = 0;
    //! Takes over what `take` wrote for granule `id` on another rank.
    virtual void give(Id id, std::span<std::byte const> bytes) = 0;
};
}
