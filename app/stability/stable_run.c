#include "app/stability/stable_run.h"

#include "app/base/program.h"
#include "app/lab/run_key.h"
#include "app/run/offscreen.h"
#include "app/stability/stable_trial.h"
#include "sim/base/stage.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- one search ---- */

typedef struct Seeker {
    const StablePlan *plan;
    const StableRows *rows; /* known trials */
    int number;
    StableCell cell;
    StableRows *made; /* new trials are made, sent and added here (equal to `rows`); NULL: no new trials */
    int pipe;
    Headless **context;
    int threads; /* per trial */
    Error *error;
} Seeker;

/* Message of a process, one per write: shorter than PIPE_BUF, so that writes are atomic. */
typedef enum Said { SAID_TRIAL, SAID_CELL, SAID_FAILURE } Said;

typedef struct Message {
    Said said;
    int cell;
    StableRow row;
    Error error;
} Message;

static bool tell(const Seeker *seeker, const Message *message)
{
    _Static_assert(sizeof *message < 4096, "a write of it is not torn");
    return write(seeker->pipe, message, sizeof *message) == (ssize_t)sizeof *message;
}

static bool make_trial(const Seeker *seeker, Scene *scene, bool whole, StableRow *row)
{
    Message message = {.said = SAID_TRIAL, .cell = seeker->number};
    if (world_on_gpu(&scene->world) && !*seeker->context &&
        !(*seeker->context = headless_create(seeker->plan->args->gpu, seeker->error)))
        return false;
    *world_threads(&scene->world) = seeker->threads;
    if (!stable_trial(scene, seeker->plan->time, whole, row, seeker->error))
        return false;
    message.row = *row;
    if (!stable_rows_add(seeker->made, row))
        return error_set(seeker->error, "no memory for the trials");
    return tell(seeker, &message) || error_set(seeker->error, "a trial cannot be told (%s)", strerror(errno));
}

/* Difference of jitter between successive starts, spacings: physically the same start, apart from chance. */
static const double START = 1e-3;

static bool try_rung(void *context, int rung, int start, bool whole, StableFound *found)
{
    static Scene scene;
    const Seeker *seeker = context;
    const StableSeries *series = &seeker->plan->series[seeker->cell.series];
    char rest[64];
    StableRow row = {.rung = rung};
    if (!stable_scene(seeker->plan, seeker->cell, &rung, &scene, seeker->error))
        return false;
    scene.world.jitter += (scene.world.jitter < 0.25 ? START : -START) * start;
    snprintf(rest, sizeof rest, "%s %.9g %d", SLOSH_VERSION, seeker->plan->time, (int)STABLE_LOOKS);
    row.key = run_key_text(RUN_KEY, rest);
    if (!run_key_scene(&scene, false, &row.key, seeker->error))
        return false;
    const StableRow *there = stable_rows_find(seeker->rows, row.key);
    if (there && whole && there->finder == FOUND_BY_LOOK)
        there = NULL;
    snprintf(row.method, NAME_SIZE, "%s", series->method);
    snprintf(row.backend, NAME_SIZE, "%s", series->backend);
    stable_at(seeker->plan, seeker->cell, row.at, sizeof row.at);
    const size_t used = strlen(row.at);
    if (start > 0)
        snprintf(row.at + used, sizeof row.at - used, "%sparticles.jitter=%g", used ? " " : "",
                 scene.world.jitter);
    if (!there && !seeker->made)
        return error_set(seeker->error, "not searched");
    if (!there && !make_trial(seeker, &scene, whole, &row))
        return false;
    there = there ? there : &row;
    *found =
        (StableFound){there->outcome.kind, there->finder == FOUND_BY_LOOK || there->finder == FOUND_BY_LOOKS};
    return true;
}

static bool seek(Seeker *seeker, StableSearch *search)
{
    static Scene scene;
    int first, most;
    seeker->cell = stable_cell(seeker->plan, seeker->number);
    if (!stable_scene(seeker->plan, seeker->cell, NULL, &scene, seeker->error))
        return false;
    stable_range(seeker->plan, &scene, &first, &most);
    return stable_search(try_rung, seeker, first, most, search);
}

bool stable_recall(const StablePlan *plan, int cell, const StableRows *rows, StableSearch *search,
                   Error *error)
{
    Seeker seeker = {.plan = plan, .rows = rows, .number = stable_searched(plan, cell), .error = error};
    return seek(&seeker, search);
}

/* ---- the processes ---- */

/* Takes cells until none is left. Results go through the pipe; the exit code is 0. */
static void work(const StablePlan *plan, StableRows *rows, int pipe, int *next, int threads)
{
    Headless *context = NULL;
    const int all = stable_cells(plan);
    for (int number; !interrupted() && (number = __atomic_fetch_add(next, 1, __ATOMIC_RELAXED)) < all;) {
        Message message = {.said = SAID_CELL, .cell = number};
        StableSearch search;
        Seeker seeker = {.plan = plan,
                         .rows = rows,
                         .number = number,
                         .made = rows,
                         .pipe = pipe,
                         .context = &context,
                         .threads = threads,
                         .error = &message.error};
        if (stable_searched(plan, number) == number && !seek(&seeker, &search))
            message.said = SAID_FAILURE;
        if (!interrupted() && !tell(&seeker, &message))
            break;
    }
    headless_destroy(context);
}

typedef struct Crew {
    const StablePlan *plan;
    StableRows *rows;
    int count, pipe, *next;
    pid_t *pid;
    int done;    /* cells */
    int *trials; /* count per cell */
    bool dirty;  /* true: some rows are not in the file yet */
    double wrote_ms;
    char told[1024]; /* the last failure, to report each once */
} Crew;

static bool start(Crew *crew, Error *error)
{
    int ends[2];
    const int most = crew->plan->threads, cells = stable_cells(crew->plan);
    const int workers = most < cells ? most : cells;
    crew->next = mmap(NULL, sizeof *crew->next, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    crew->pid = calloc((size_t)workers, sizeof *crew->pid);
    crew->trials = calloc((size_t)cells, sizeof *crew->trials);
    if (crew->next == MAP_FAILED || !crew->pid || !crew->trials || pipe(ends) != 0)
        return error_set(error, "the trials cannot be started (%s)", strerror(errno));
    crew->pipe = ends[0];
    fflush(NULL);
    const pid_t parent = getpid();
    for (; crew->count < workers; crew->count++) {
        const pid_t pid = fork();
        if (pid < 0)
            break;
        if (pid == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL); /* a killed command leaves no processes */
            close(ends[0]);
            if (getppid() == parent)
                work(crew->plan, crew->rows, ends[1], crew->next, most / workers);
            _exit(0);
        }
        crew->pid[crew->count] = pid;
    }
    close(ends[1]);
    return crew->count > 0 || error_set(error, "the trials cannot be started (%s)", strerror(errno));
}

static bool keep(Crew *crew, bool now, Error *error)
{
    static const double EVERY_MS = 200;
    if (!crew->dirty || (!now && wall_ms() < crew->wrote_ms + EVERY_MS))
        return true;
    crew->dirty = false;
    const bool ok = stable_rows_merge(crew->rows, crew->plan->csv, error) &&
                    stable_rows_write(crew->rows, crew->plan->csv, error);
    crew->wrote_ms = wall_ms();
    return ok;
}

static bool take(Crew *crew, const Message *message, Error *error)
{
    if (message->said == SAID_TRIAL) {
        crew->trials[message->cell]++;
        crew->dirty = true;
        return stable_rows_add(crew->rows, &message->row) || error_set(error, "no memory for the trials");
    }
    crew->done++;
    crew->trials[message->cell] = 0;
    if (message->said == SAID_FAILURE && strcmp(crew->told, message->error.message) != 0) {
        snprintf(crew->told, sizeof crew->told, "%s", message->error.message);
        fprintf(stderr, "not searched: %s\n", crew->told);
    }
    return true;
}

/* A search takes about twenty trials. */
static double share(const Crew *crew)
{
    const int cells = stable_cells(crew->plan);
    double done = crew->done;
    for (int c = 0; c < cells; c++)
        done += crew->trials[c] < 18 ? 0.05 * crew->trials[c] : 0.9;
    return done / cells;
}

/* Reads messages until all processes have closed the pipe. Returns false if a trial cannot be kept, or
   after a signal. */
static bool listen_to(Crew *crew, Progress *progress, Error *error)
{
    struct pollfd ready = {.fd = crew->pipe, .events = POLLIN};
    Message message;
    bool ok = true;
    while (ok && !interrupted()) {
        const int polled = poll(&ready, 1, 100);
        ok = keep(crew, false, error);
        if (polled <= 0 || !ok)
            continue;
        const ssize_t size = read(crew->pipe, &message, sizeof message);
        if (size == 0)
            break;
        if (size == (ssize_t)sizeof message)
            ok = take(crew, &message, error);
        progress_update(progress, share(crew));
    }
    return ok && !interrupted();
}

/* Ends the processes. Messages still in the pipe are kept, too. */
static bool end(Crew *crew, bool ok, Error *error)
{
    Message message;
    bool died = false;
    int number = 0;
    for (int i = 0; i < crew->count && !ok; i++)
        kill(crew->pid[i], interrupted() ? SIGTERM : SIGKILL);
    while (ok ? false : read(crew->pipe, &message, sizeof message) == (ssize_t)sizeof message)
        take(crew, &message, error);
    for (int i = 0; i < crew->count; i++) {
        int status = 0;
        waitpid(crew->pid[i], &status, 0);
        died |= ok && status != 0;
        number = died && WIFSIGNALED(status) ? WTERMSIG(status) : number;
    }
    Error none;
    if (!keep(crew, true, ok ? error : &none))
        return false;
    if (died && number == 0)
        return error_set(error, "a trial ended early; is memory short?");
    if (died)
        return error_set(error, "a trial was ended by signal %d (%s); is memory short?", number,
                         strsignal(number));
    return ok;
}

bool stable_run(const StablePlan *plan, StableRows *rows, Error *error)
{
    Crew crew = {.plan = plan, .rows = rows, .pipe = -1, .wrote_ms = wall_ms()};
    Progress progress;
    progress_begin(&progress, stderr, "stability", plan->args->quiet);
    bool ok = start(&crew, error);
    if (ok) {
        ok = listen_to(&crew, &progress, error);
        ok = end(&crew, ok, error);
        close(crew.pipe);
    }
    progress_end(&progress);
    free(crew.pid);
    free(crew.trials);
    return ok;
}
