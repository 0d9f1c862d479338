#include "granum/dem/halo.hpp"

#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace granum::dem
{
using particle::Columns;

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

// What a rank is told about a granule of another.
struct Copy
{
    kernel::Body body;
    Id id;
    std::uint64_t material;
};
}

std::vector<ContactRecord> Halo::migrate(
    particle::Store& granules,
    std::function<std::vector<ContactRecord>(std::vector<std::uint32_t> const&)> const& contacts_of,
    std::span<particle::Attachment* const> attachments, std::vector<std::uint32_t>& kept) const
{
    kept.clear();
    std::vector<std::uint32_t> leaving;
    std::vector<int> to;
    for (std::uint32_t row = 0; row < granules.owned; ++row) {
        int const rank = owner(granules.position[row]);
        if (rank == comm_.rank()) {
            kept.push_back(row);
        } else {
            leaving.push_back(row);
            to.push_back(rank);
        }
    }
    if (comm_.max(leaving.empty() ? 0L : 1L) == 0) return {};
    // The partner that stays behind needs the history too, so it is copied, not moved.
    std::unordered_map<Id, std::vector<ContactRecord>> contacts;
    for (auto const row : leaving) contacts[granules.id[row]];
    for (auto const& record : contacts_of(leaving))
        for (Id const id : {record.low, record.high})
            if (auto const found = contacts.find(id); found != contacts.end()) found->second.push_back(record);
    std::vector<std::vector<std::byte>> to_each(static_cast<std::size_t>(comm_.size()));
    for (std::size_t k = 0; k < leaving.size(); ++k) {
        auto& bytes = to_each[static_cast<std::size_t>(to[k])];
        Id const id = granules.id[leaving[k]];
        pack_row(granules, leaving[k], Columns::all, bytes);
        append(bytes, contacts[id].size());
        for (auto const& record : contacts[id]) append(bytes, record);
        for (auto* attachment : attachments) {
            std::vector<std::byte> mine;
            attachment->take(id, mine);
            append(bytes, mine.size());
            bytes.insert(bytes.end(), mine.begin(), mine.end());
        }
    }
    if (!leaving.empty()) reorder(granules, kept);
    std::vector<ContactRecord> arrived;
    for (auto const& from : comm_.deliver(to_each)) {
        std::span<std::byte const> bytes(from);
        while (!bytes.empty()) {
            std::size_t const row = granules.rows();
            granules.resize(row + 1);
            granules.owned = row + 1;
            bytes = unpack_row(granules, row, Columns::all, bytes);
            for (auto left = take<std::size_t>(bytes); left > 0; --left) arrived.push_back(take<ContactRecord>(bytes));
            for (auto* attachment : attachments) {
                auto const size = take<std::size_t>(bytes);
                attachment->give(granules.id[row], bytes.first(size));
                bytes = bytes.subspan(size);
            }
        }
    }
    return arrived;
}

void Halo::fill(Frame& frame, double reach)
{
    sides_.clear();
    std::vector<std::vector<std::byte>> to_each(static_cast<std::size_t>(comm_.size()));
    for (int const rank : partition_.near(comm_.rank(), reach)) {
        auto& side = sides_.emplace_back(Side{.rank = rank});
        auto& bytes = to_each[static_cast<std::size_t>(rank)];
        for (std::uint32_t row = 0; row < frame.owned; ++row) {
            if (partition_.distance2(frame.position(row), rank) >= reach * reach) continue;
            side.rows.push_back(row);
            append(bytes, Copy{frame.bodies[row], frame.id[row], frame.material[row]});
        }
    }
    auto const from_each = comm_.deliver(to_each);
    std::size_t rows = frame.owned;
    for (auto& side : sides_) {
        side.first = rows;
        side.count = from_each[static_cast<std::size_t>(side.rank)].size() / sizeof(Copy);
        rows += side.count;
        side.out.resize(9 * side.rows.size());
        side.in.resize(9 * side.count);
    }
    frame.resize(rows);
    for (auto const& side : sides_) {
        std::span<std::byte const> bytes(from_each[static_cast<std::size_t>(side.rank)]);
        for (std::size_t k = 0; k < side.count; ++k) {
            auto const copy = take<Copy>(bytes);
            frame.bodies[side.first + k] = copy.body;
            frame.id[side.first + k] = copy.id;
            frame.material[side.first + k] = static_cast<std::uint8_t>(copy.material);
        }
    }
}

void Halo::begin_refresh(Frame const& frame)
{
    requests_.clear();
    for (auto& side : sides_)
        MPI_Irecv(side.in.data(), static_cast<int>(side.in.size()), MPI_DOUBLE, side.rank, 3, comm_.handle(),
                  &requests_.emplace_back());
    for (auto& side : sides_) {
        double* next = side.out.data();
        for (auto const row : side.rows) {
            auto const& body = frame.bodies[row];
            for (auto const* from : {body.position, body.velocity, body.spin}) next = std::copy_n(from, 3, next);
        }
        MPI_Isend(side.out.data(), static_cast<int>(side.out.size()), MPI_DOUBLE, side.rank, 3, comm_.handle(),
                  &requests_.emplace_back());
    }
}

void Halo::end_refresh(Frame& frame)
{
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    for (auto const& side : sides_) {
        double const* got = side.in.data();
        for (std::size_t k = 0; k < side.count; ++k, got += 9) {
            auto& body = frame.bodies[side.first + k];
            std::copy_n(got, 3, body.position);
            std::copy_n(got + 3, 3, body.velocity);
            std::copy_n(got + 6, 3, body.spin);
        }
    }
}

void Halo::refresh_all(Frame& frame)
{
    std::vector<std::vector<std::byte>> to_each(static_cast<std::size_t>(comm_.size()));
    for (auto const& side : sides_)
        for (auto const row : side.rows)
            append(to_each[static_cast<std::size_t>(side.rank)],
                   Copy{frame.bodies[row], frame.id[row], frame.material[row]});
    auto const from_each = comm_.deliver(to_each);
    for (auto const& side : sides_) {
        std::span<std::byte const> bytes(from_each[static_cast<std::size_t>(side.rank)]);
        for (std::size_t k = 0; k < side.count; ++k) frame.bodies[side.first + k] = take<Copy>(bytes).body;
    }
}

void Halo::spread(std::vector<double>& of_rows) const
{
    std::vector<MPI_Request> requests;
    std::vector<std::vector<double>> sent;
    for (auto const& side : sides_)
        MPI_Irecv(of_rows.data() + side.first, static_cast<int>(side.count), MPI_DOUBLE, side.rank, 4, comm_.handle(),
                  &requests.emplace_back());
    for (auto const& side : sides_) {
        auto& out = sent.emplace_back();
        for (auto const row : side.rows) out.push_back(of_rows[row]);
        MPI_Isend(out.data(), static_cast<int>(out.size()), MPI_DOUBLE, side.rank, 4, comm_.handle(),
                  &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}
}
