/// \file
/// vtm::Error, the base class of the errors of every module.
#pragma once

#include <stdexcept>

#pragma GCC visibility push(default)

namespace vtm {

/// Bad input, an exceeded limit, or a failure to read, draw or write. what() names the place and the cause.
/// The only other exceptions thrown are those of the standard library: std::invalid_argument,
/// std::length_error and std::out_of_range for arguments outside the ranges that the headers state, and
/// std::bad_alloc.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace vtm

#pragma GCC visibility pop
