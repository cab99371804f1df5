/// \file
/// What figures belong to.
#pragma once

#include "bench/measure/table.hpp"

namespace vtm::bench {

/// Processor, cores, memory, system, compiler, driver of OpenGL, load and date, as an object of strings and
/// numbers. Nothing that names a machine or its user.
Json machineFacts();

}  // namespace vtm::bench
