#include "granum/dem/halo.hpp"

#include "granum/base/error.hpp"
#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace granum::dem
{
using particle::Columns;

Halo::Halo(Domain const& domain, par::Slabs const& slabs, par::Communicator const& comm)
    : domain_(domain), slabs_(slabs), comm_(comm)
{
    // Across ranks the neighbours along x give the ghosts; on one rank they are images like those of y and z.
    if (comm_.size() == 1) return;
    int const rank = comm_.rank();
    int const left = slabs_.left(rank), right = slabs_.right(rank);
    bool const first = rank == 0, last = rank + 1 == slabs_.ranks();
    double const length = slabs_.length();
    sides_[0].to = left, sides_[0].from = right, sides_[0].shift.x = last ? length : 0;
    sides_[1].to = right, sides_[1].from = left, sides_[1].shift.x = first ? -length : 0;
}

void Halo::check_width(double largest_radius, double reach) const
{
    constexpr std::array names{"x", "y", "z"};
    for (std::size_t d = 0; d < 3; ++d) {
        double const width = domain_.upper[d] - domain_.lower[d];
        base::require(
            !domain_.periodic[d] || (width > 4 * largest_radius && width >= reach),
            "the periodic domain is {:.4g} m wide along {}, but must be wider than two diameters of the largest "
            "granule ({:.4g} m), so that no granule meets another from both sides",
            width, names[d], 4 * largest_radius);
    }
    if (comm_.size() == 1) return;
    for (int rank = 0; rank < slabs_.ranks(); ++rank)
        base::require(slabs_.upper(rank) - slabs_.lower(rank) >= reach,
                      "the slab of rank {} is {:.4g} m wide, but granules reach {:.4g} m: run on fewer ranks", rank,
                      slabs_.upper(rank) - slabs_.lower(rank), reach);
}

bool Halo::strayed(particle::Store const& granules) const
{
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto const& x = granules.position[row];
        for (std::size_t d = 0; d < 3; ++d)
            if (domain_.periodic[d] && (x[d] < domain_.lower[d] || x[d] >= domain_.upper[d])) return true;
        if (comm_.size() > 1 && slabs_.owner(x.x) != comm_.rank()) return true;
    }
    return false;
}

namespace
{
template <class T>
void append(std::vector<std::byte>& bytes, T const& value)
{
    auto const* first = reinterpret_cast<std::byte const*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
}

template <class T>
T take(std::span<std::byte const>& bytes)
{
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    bytes = bytes.subspan(sizeof(T));
    return value;
}

// One granule with its contacts and what is attached to it.
void pack_granule(particle::Store const& granules, std::uint32_t row, std::vector<SavedContacts::Entry> const& contacts,
                  std::span<particle::Attachment* const> attachments, std::vector<std::byte>& bytes)
{
    pack_row(granules, row, Columns::all, bytes);
    append(bytes, contacts.size());
    for (auto const& contact : contacts) append(bytes, contact);
    for (auto* attachment : attachments) {
        std::vector<std::byte> mine;
        attachment->take(granules.id[row], mine);
        append(bytes, mine.size());
        bytes.insert(bytes.end(), mine.begin(), mine.end());
    }
}

void unpack_granules(particle::Store& granules, std::span<std::byte const> bytes, SavedContacts& contacts,
                     std::span<particle::Attachment* const> attachments)
{
    while (!bytes.empty()) {
        std::size_t const row = granules.rows();
        granules.resize(row + 1);
        granules.owned = row + 1;
        bytes = unpack_row(granules, row, Columns::all, bytes);
        for (auto left = take<std::size_t>(bytes); left > 0; --left) contacts.add(take<SavedContacts::Entry>(bytes));
        for (auto* attachment : attachments) {
            auto const size = take<std::size_t>(bytes);
            attachment->give(granules.id[row], bytes.first(size));
            bytes = bytes.subspan(size);
        }
    }
}
}

void Halo::settle(particle::Store& granules, SavedContacts& contacts,
                  std::span<particle::Attachment* const> attachments) const
{
    granules.resize(granules.owned);
    for (std::size_t row = 0; row < granules.owned; ++row)
        for (std::size_t d = 0; d < 3; ++d) {
            double const low = domain_.lower[d], high = domain_.upper[d];
            double& x = granules.position[row][d];
            if (!domain_.periodic[d] || (x >= low && x < high)) continue;
            x -= (high - low) * std::floor((x - low) / (high - low));
            if (x < low || x >= high) x = low;  // rounding at the face
        }
    if (comm_.size() == 1) return;
    int const rank = comm_.rank();
    while (true) {
        std::vector<std::uint32_t> stay, left, right;
        for (std::uint32_t row = 0; row < granules.owned; ++row) {
            int const owner = slabs_.owner(granules.position[row].x);
            if (owner == rank)
                stay.push_back(row);
            else if (owner == slabs_.right(rank) || (owner > rank && owner != slabs_.left(rank)))
                right.push_back(row);
            else
                left.push_back(row);
        }
        if (comm_.sum(static_cast<long>(left.size() + right.size())) == 0) return;
        // The partner that stays behind needs the history too, so it is copied, not moved.
        std::unordered_map<Id, std::vector<SavedContacts::Entry>> leaving;
        for (auto const row : left) leaving[granules.id[row]];
        for (auto const row : right) leaving[granules.id[row]];
        if (!leaving.empty())
            for (auto const& entry : contacts.entries())
                for (Id const id : {entry.first, entry.second})
                    if (auto const found = leaving.find(id); found != leaving.end()) found->second.push_back(entry);
        std::vector<std::byte> to_left, to_right;
        for (auto const row : left) pack_granule(granules, row, leaving[granules.id[row]], attachments, to_left);
        for (auto const row : right) pack_granule(granules, row, leaving[granules.id[row]], attachments, to_right);
        if (stay.size() < granules.owned) reorder(granules, stay);
        unpack_granules(granules, comm_.exchange(to_left, slabs_.left(rank), slabs_.right(rank)), contacts,
                        attachments);
        unpack_granules(granules, comm_.exchange(to_right, slabs_.right(rank), slabs_.left(rank)), contacts,
                        attachments);
    }
}

void Halo::fill(particle::Store& granules, double reach)
{
    granules.resize(granules.owned);
    int const rank = comm_.rank();
    for (std::size_t side = 0; side < 2; ++side) {
        auto& [to, from, shift, rows, first, count, out, in] = sides_[side];
        rows.clear();
        std::vector<std::byte> bytes;
        if (to >= 0)
            for (std::uint32_t row = 0; row < granules.owned; ++row) {
                double const x = granules.position[row].x;
                bool const near = side == 0 ? x < slabs_.lower(rank) + reach : x >= slabs_.upper(rank) - reach;
                if (!near) continue;
                rows.push_back(row);
                pack_row(granules, row, Columns::halo, bytes);
            }
        first = granules.rows();
        count = 0;
        if (to < 0 && from < 0) continue;
        auto const received = comm_.exchange(bytes, to, from);
        count = received.size() / particle::packed_size(granules, Columns::halo);
        granules.resize(first + count);
        std::span<std::byte const> rest(received);
        for (std::size_t k = 0; k < count; ++k) {
            rest = unpack_row(granules, first + k, Columns::halo, rest);
            granules.position[first + k] += shift;
        }
        out.resize(9 * rows.size());
        in.resize(9 * count);
    }
    images_.clear();
    first_image_ = granules.rows();
    for (std::size_t d = 0; d < 3; ++d)
        if (domain_.periodic[d] && (d > 0 || comm_.size() == 1)) add_images(granules, d, reach);
}

void Halo::add_images(particle::Store& granules, std::size_t direction, double reach)
{
    double const low = domain_.lower[direction], high = domain_.upper[direction];
    Vec3 shift;
    shift[direction] = high - low;
    std::size_t const begin = images_.size(), rows = granules.rows();
    for (std::uint32_t row = 0; row < rows; ++row) {
        double const x = granules.position[row][direction];
        if (x < low + reach) images_.push_back({row, shift});
        if (x >= high - reach) images_.push_back({row, -shift});
    }
    granules.resize(rows + images_.size() - begin);
    for (std::size_t k = begin; k < images_.size(); ++k)
        for_each_column(granules, [&](auto& column) {
            if (column.traits.halo) column[first_image_ + k] = column[images_[k].row];
        });
    for (std::size_t k = begin; k < images_.size(); ++k) granules.position[first_image_ + k] += images_[k].shift;
}

void Halo::refresh_motion(particle::Store& granules)
{
    auto& x = granules.position.values;
    auto& v = granules.velocity.values;
    auto& w = granules.spin.values;
    for (auto& [to, from, shift, rows, first, count, out, in] : sides_) {
        if (to < 0 && from < 0) continue;
        double* next = out.data();
        for (auto const row : rows)
            for (Vec3 const& value : {x[row], v[row], w[row]}) *next++ = value.x, *next++ = value.y, *next++ = value.z;
        MPI_Sendrecv(out.data(), static_cast<int>(out.size()), MPI_DOUBLE, to < 0 ? MPI_PROC_NULL : to, 3, in.data(),
                     static_cast<int>(in.size()), MPI_DOUBLE, from < 0 ? MPI_PROC_NULL : from, 3, comm_.handle(),
                     MPI_STATUS_IGNORE);
        double const* got = in.data();
        for (std::size_t k = 0; k < count; ++k, got += 9) {
            x[first + k] = Vec3{got[0], got[1], got[2]} + shift;
            v[first + k] = {got[3], got[4], got[5]};
            w[first + k] = {got[6], got[7], got[8]};
        }
    }
    for (std::size_t k = 0; k < images_.size(); ++k) {
        auto const row = images_[k].row;
        x[first_image_ + k] = x[row] + images_[k].shift;
        v[first_image_ + k] = v[row];
        w[first_image_ + k] = w[row];
    }
}

void Halo::refresh_all(particle::Store& granules) const
{
    for (auto const& side : sides_) {
        if (side.to < 0 && side.from < 0) continue;
        std::vector<std::byte> bytes;
        for (auto const row : side.rows) pack_row(granules, row, Columns::halo, bytes);
        auto const received = comm_.exchange(bytes, side.to, side.from);
        std::span<std::byte const> rest(received);
        for (std::size_t k = 0; k < side.count; ++k) {
            rest = unpack_row(granules, side.first + k, Columns::halo, rest);
            granules.position[side.first + k] += side.shift;
        }
    }
    for (std::size_t k = 0; k < images_.size(); ++k) {
        for_each_column(granules, [&](auto& column) {
            if (column.traits.halo) column[first_image_ + k] = column[images_[k].row];
        });
        granules.position[first_image_ + k] += images_[k].shift;
    }
}
}
