#pragma once
// Arrays that begin at a cache line, for loops that read and write whole lines.

#include <boost/align/aligned_allocator.hpp>

#include <vector>

namespace sandglass {

template <class T> using AlignedVector = std::vector<T, boost::alignment::aligned_allocator<T, 64>>;

} // namespace sandglass
