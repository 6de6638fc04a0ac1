// Whether a launcher of MPI programs started this one.
#pragma once

#include <cstdlib>
#include <string>

namespace hyalite {

/// The number of ranks that Open MPI, MPICH, PMIx or Slurm's srun tells a program before MPI is initialised; 1 if there is
/// none. Slurm tells batch jobs, too, that are no MPI programs: there the step's own manager counts.
[[nodiscard]] inline int startedRanks() {
    for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
        if (const char *text = std::getenv(name))
            return std::atoi(text);
    return 1;
}

} // namespace hyalite
