#include "granum/io/events_file.hpp"

#include "granum/base/error.hpp"

#include <algorithm>

namespace granum::io
{
namespace
{
constexpr std::size_t chunk_rows = 4096;
}

EventsWriter::EventsWriter(std::string const& path, std::vector<EventColumn> const& columns)
    : path_(path), columns_(columns), file_(create_hdf5(path))
{
    base::require(!columns.empty(), "{}: an event file needs columns", path);
    // Links keep the order of their making, so that the reader gives the columns back as declared.
    Hdf5Handle ordered(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, path_, "be prepared");
    check_hdf5(H5Pset_link_creation_order(ordered, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), path_,
               "be prepared");
    Hdf5Handle group(H5Gcreate2(file_, "events", H5P_DEFAULT, ordered, H5P_DEFAULT), H5Gclose, path_, "hold /events");

    Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path_, "be prepared");
    hsize_t const chunk = chunk_rows, none = 0, unlimited = H5S_UNLIMITED;
    check_hdf5(H5Pset_chunk(list, 1, &chunk), path_, "be prepared");
    check_hdf5(H5Pset_shuffle(list), path_, "be prepared");
    check_hdf5(H5Pset_deflate(list, 1), path_, "be compressed");
    Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose, path_, "be prepared");
    for (auto const& column : columns_) {
        sets_.emplace_back(
            H5Dcreate2(group, column.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT), H5Dclose,
            path_, "hold the column " + column.name);
        write_text_attribute(sets_.back(), path_, "unit", column.unit);
        write_text_attribute(sets_.back(), path_, "doc", column.doc);
    }
    check_hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), path_, "be flushed");
}

EventsWriter::~EventsWriter()
{
    try {
        flush();
    } catch (std::exception const&) {
        // A destructor cannot report; callers that must know call flush() themselves.
    }
}

void EventsWriter::append(std::span<double const> rows)
{
    base::require(rows.size() % columns_.size() == 0, "{}: {} numbers are not whole rows of {}", path_, rows.size(),
                  columns_.size());
    waiting_.insert(waiting_.end(), rows.begin(), rows.end());
    if (waiting_.size() >= chunk_rows * columns_.size()) flush();
}

void EventsWriter::flush()
{
    if (waiting_.empty()) return;
    hsize_t const count = waiting_.size() / columns_.size(), start = written_, total = start + count;
    Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, path_, "be extended");
    std::vector<double> column(count);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        for (std::size_t row = 0; row < count; ++row) column[row] = waiting_[row * columns_.size() + c];
        check_hdf5(H5Dset_extent(sets_[c], &total), path_, "be extended");
        Hdf5Handle space(H5Dget_space(sets_[c]), H5Sclose, path_, "be extended");
        check_hdf5(H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &count, nullptr), path_, "be extended");
        check_hdf5(H5Dwrite(sets_[c], H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, column.data()), path_,
                   "be written; is the disk full?");
    }
    check_hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), path_, "be flushed; is the disk full?");
    written_ = total;
    waiting_.clear();
}

std::vector<double> const* EventTable::find(std::string const& name) const
{
    for (std::size_t column = 0; column < columns.size(); ++column)
        if (columns[column].name == name) return &values[column];
    return nullptr;
}

EventTable read_events(std::string const& path)
{
    auto const file = open_hdf5(path);
    Hdf5Handle group(H5Gopen2(file, "events", H5P_DEFAULT), H5Gclose, path, "find /events");
    H5G_info_t info;
    check_hdf5(H5Gget_info(group, &info), path, "list /events");
    EventTable table;
    for (hsize_t link = 0; link < info.nlinks; ++link) {
        auto const length =
            H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, link, nullptr, 0, H5P_DEFAULT);
        if (length < 0) throw base::IoError(fmt::format("{}: cannot list /events", path));
        std::string name(static_cast<std::size_t>(length), '\0');
        H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, link, name.data(), name.size() + 1,
                           H5P_DEFAULT);
        Hdf5Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, path, "open the column " + name);
        table.columns.push_back({name, read_text_attribute(set, path, "unit"), read_text_attribute(set, path, "doc")});
        table.values.push_back(read_numbers(group, path, name));
    }
    if (table.values.empty()) return table;
    auto const shortest = std::min_element(table.values.begin(), table.values.end(),
                                           [](auto const& a, auto const& b) { return a.size() < b.size(); });
    std::size_t const rows = shortest->size();
    for (auto& column : table.values) column.resize(rows);
    return table;
}
}
