#include "granum/io/hdf5_file.hpp"

#include "granum/base/error.hpp"

namespace granum::io
{
namespace
{
//! Access without file locks, which network file systems lack and which would keep a report off a running case.
Hdf5Handle access(std::string const& path)
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // we say it ourselves, once
    Hdf5Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "be prepared");
    check_hdf5(H5Pset_file_locking(list, false, true), path, "be prepared");
    return list;
}
}

Hdf5Handle::Hdf5Handle(hid_t id, Close close, std::string const& path, std::string const& what) : id_(id), close_(close)
{
    if (id < 0) throw base::IoError(fmt::format("{}: cannot {}", path, what));
}

void check_hdf5(herr_t status, std::string const& path, std::string const& what)
{
    if (status < 0) throw base::IoError(fmt::format("{}: cannot {}", path, what));
}

Hdf5Handle create_hdf5(std::string const& path)
{
    auto const list = access(path);
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, list), H5Fclose, path, "be created"};
}

Hdf5Handle open_hdf5(std::string const& path)
{
    auto const list = access(path);
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, list), H5Fclose, path,
            "be opened: missing, or not a complete HDF5 file"};
}

void write_text_attribute(hid_t object, std::string const& path, char const* name, std::string const& text)
{
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path, "hold text");
    check_hdf5(H5Tset_size(type, text.size() + 1), path, "hold text");
    Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, path, "hold text");
    Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
                         fmt::format("hold the attribute {}", name));
    check_hdf5(H5Awrite(attribute, type, text.c_str()), path, fmt::format("write the attribute {}", name));
}

std::string read_text_attribute(hid_t object, std::string const& path, char const* name)
{
    Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, path,
                         fmt::format("find the attribute {}", name));
    Hdf5Handle type(H5Aget_type(attribute), H5Tclose, path, fmt::format("read the attribute {}", name));
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
        throw base::IoError(fmt::format("{}: the attribute {} is not plain text", path, name));
    std::string text(H5Tget_size(type) + 1, '\0');
    check_hdf5(H5Aread(attribute, type, text.data()), path, fmt::format("read the attribute {}", name));
    return text.c_str();
}

void write_numbers(hid_t place, std::string const& path, std::string const& name, std::vector<double> const& numbers)
{
    hsize_t const size = numbers.size();
    Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, path, "hold " + name);
    Hdf5Handle set(H5Dcreate2(place, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose, path, "hold " + name);
    if (size > 0)
        check_hdf5(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), path,
                   "write " + name);
}

std::vector<double> read_numbers(hid_t place, std::string const& path, std::string const& name)
{
    Hdf5Handle set(H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose, path, "find " + name);
    Hdf5Handle space(H5Dget_space(set), H5Sclose, path, "read " + name);
    if (H5Sget_simple_extent_ndims(space) != 1) throw base::IoError(fmt::format("{}: {} is not a column", path, name));
    hsize_t size = 0;
    H5Sget_simple_extent_dims(space, &size, nullptr);
    std::vector<double> numbers(size);
    if (size > 0)
        check_hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), path,
                   "read " + name);
    return numbers;
}
}
