/* What the CPU device takes from others, and nearly each of its files: the build has compilers read it once for all. */
#ifndef CAROM_CPU_FOREIGN_HPP
#define CAROM_CPU_FOREIGN_HPP

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#endif
