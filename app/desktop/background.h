#pragma once
// Keeps work that can wait out of the way of the simulation.

namespace sandglass::desktop {

/// Lowers the priority of the calling thread and of threads that it starts later; 0 is normal, 19 the lowest.
/// Does nothing where the system has no priority of single threads.
void lowerPriority(int nice);

/// Seconds of processor time that the calling thread has used.
double threadSeconds();

/// The software rasteriser otherwise starts a thread per core. To be called before the first GL context is
/// made; a value that the user has set stays.
void limitRasteriserThreads();

} // namespace sandglass::desktop
