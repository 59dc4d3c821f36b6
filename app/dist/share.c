#include "app/dist/share.h"

#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

#include <mpi.h>

static hid_t access_together(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
    H5Pset_coll_metadata_write(access, true);
    return access;
}

static hid_t transfer_together(void)
{
    hid_t transfer = H5Pcreate(H5P_DATASET_XFER);
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
    return transfer;
}

bool dist_agree(bool ok, Error *error)
{
    int rank, ranks, failed;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    failed = ok ? ranks : rank;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (failed < ranks)
        MPI_Bcast(error, sizeof *error, MPI_BYTE, failed, MPI_COMM_WORLD);
    return failed == ranks;
}

static void end_all(const Error *error)
{
    dist_die("%s", error->message);
}

static void tell(void *bytes, size_t size)
{
    MPI_Bcast(bytes, (int)size, MPI_BYTE, 0, MPI_COMM_WORLD);
}

static size_t before(size_t count, size_t *all)
{
    uint64_t own = count, sum = 0, total = 0;
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Exscan(&own, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(&own, &total, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    *all = total;
    return rank == 0 ? 0 : sum;
}

const SnapshotParallel *dist_share(void)
{
    static SnapshotParallel share = {.access = access_together,
                                     .transfer = transfer_together,
                                     .agree = dist_agree,
                                     .end = end_all,
                                     .tell = tell,
                                     .held = ranks_owned,
                                     .before = before};
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    share.first = rank == 0;
    return &share;
}
