// The few HDF5 calls that our files need, each checked, with an error that names the file.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace granum::io
{
//! Owns one HDF5 identifier.
class Hdf5Handle
{
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle() = default;
    //! Throws base::IoError "path: cannot <what>" if `id` is negative, as HDF5 returns on failure.
    Hdf5Handle(hid_t id, Close close, std::string const& path, std::string const& what);
    Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept
    {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Handle()
    {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

//! Throws base::IoError "path: cannot <what>" if `status` is negative.
void check_hdf5(herr_t status, std::string const& path, std::string const& what);

//! Starts `path` anew, or opens it for reading. Without file locks: a report may be made of a run that goes on.
Hdf5Handle create_hdf5(std::string const& path);
Hdf5Handle open_hdf5(std::string const& path);

void write_text_attribute(hid_t object, std::string const& path, char const* name, std::string const& text);
std::string read_text_attribute(hid_t object, std::string const& path, char const* name);

//! A whole one-dimensional data set of doubles.
void write_numbers(hid_t place, std::string const& path, std::string const& name, std::vector<double> const& numbers);
std::vector<double> read_numbers(hid_t place, std::string const& path, std::string const& name);
}
