// The program without MPI.
#include "host/base/error.h"
#include "host/farm/ranks.h"
#include "host/farm/ranks_started.h"

namespace hyalite {

std::unique_ptr<Ranks> joinRanks() {
    if (startedRanks() > 1)
        throw Error(ErrorKind::Usage,
                    "this program was built without MPI, and each process that mpirun starts would "
                    "render the same: build it with -DHYALITE_MPI=ON");
    return nullptr;
}

} // namespace hyalite
