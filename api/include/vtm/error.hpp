/// \file
/// What every error of the library is: catch vtm::Error, or one of the modules' own classes.
#pragma once

#include <stdexcept>

#pragma GCC visibility push(default)

namespace vtm {

/// Bad input, a limit, or something that could not be read, drawn or written. what() names the place and the
/// cause. Beside it only the standard library's exceptions are thrown: std::invalid_argument,
/// std::length_error and std::out_of_range for arguments outside the ranges that headers state,
/// std::bad_alloc.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace vtm

#pragma GCC visibility pop
