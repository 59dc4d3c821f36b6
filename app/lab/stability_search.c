#include "app/base/program.h"
#include "app/lab/stability.h"
#include "app/run/measure/measure.h"
#include "app/run/offscreen.h"
#include "sim/world.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *const finders[] = {
#define X(NAME, word) word,
    STABLE_FINDERS(X)
#undef X
        NULL};

static const TrialColumn columns[] = {
    {"method", CELL_TEXT, CELL(StableRow, method)},
    {"backend", CELL_TEXT, CELL(StableRow, backend)},
    {"rung", CELL_INTEGER, CELL(StableRow, rung), .least = -400, .most = 100},
    {"step_s", CELL_NUMBER, CELL(StableRow, step), .most = 1e6, .digits = 9},
    {"steps", CELL_INTEGER, CELL(StableRow, steps), .most = 1e15},
    {"found_by", CELL_WORD, CELL(StableRow, finder), .words = finders},
    {"outcome", CELL_OUTCOME, CELL(StableRow, outcome)},
    {"at", CELL_TEXT, CELL(StableRow, at), .flags = CELL_EMPTY},
    {NULL},
};

static bool is_possible(const void *of)
{
    const StableRow *row = of;
    return row->outcome.kind != OUTCOME_NONE &&
           (row->finder == FOUND_BY_NOBODY) == (row->outcome.kind == OUTCOME_HOLDS);
}

/* A complete trial replaces a trial ended by a look. */
static bool knows_more(const void *other, const void *own)
{
    return ((const StableRow *)own)->finder == FOUND_BY_LOOK &&
           ((const StableRow *)other)->finder != FOUND_BY_LOOK;
}

/* By method, backend, cell and step: the same rows give the same file. */
static int order(const void *one, const void *other)
{
    const StableRow *a = *(const StableRow *const *)one, *b = *(const StableRow *const *)other;
    int way = strcmp(a->method, b->method);
    way = way ? way : strcmp(a->backend, b->backend);
    way = way ? way : strcmp(a->at, b->at);
    way = way ? way : a->rung - b->rung;
    return way ? way : (a->key > b->key) - (a->key < b->key);
}

const TrialTable stable_table = {
    .who = "slosh stability",
    .result = "map",
    .trial = "trial",
    .head = "key,method,backend,rung,step_s,steps,found_by,outcome,outcome_s,outcome_words,at\n",
    .opening = "key,method,backend,rung,",
    .row_size = sizeof(StableRow),
    .columns = columns,
    .possible = is_possible,
    .replaces = knows_more,
    .order = order,
};

typedef struct Trial {
    const Scene *scene;
    World *world;
    WorldInfo info;
    OutcomeHistory history;
    double next; /* time of the next look, s */
    bool whole;
} Trial;

/* Looks at a sound state, if a look is due or `now`. Returns false if memory is short. */
static bool look(Trial *trial, double until, bool now, Error *error)
{
    if ((!now && trial->info.time < trial->next) || !world_is_valid(trial->world))
        return true;
    trial->next = trial->info.time + 0.999 * until / STABLE_LOOKS;
    return outcome_sample(&trial->history, &trial->scene->world, false, trial->world) ||
           error_set(error, "no memory to read the particles; use a larger spacing");
}

/* True at the sentinel's first trouble; the sentinel's reaction does not matter. */
static bool in_trouble(Trial *trial)
{
    const bool found = trial->info.trouble.count > 0 || trial->info.trouble.ended;
    outcome_end(&trial->history, trial->world);
    trial->history.trouble.ended = found;
    return found;
}

/* True if a look has found trouble that ends the trial. */
static bool seen_enough(const Trial *trial)
{
    Outcome outcome;
    outcome_judge(&trial->history, &outcome);
    return !trial->whole && outcome.kind > OUTCOME_HOLDS;
}

static bool run(Trial *trial, double until, Error *error)
{
    Error failure = {{0}};
    bool stepped = true, ok = look(trial, until, true, error);
    while (ok && stepped && !in_trouble(trial) && !seen_enough(trial) && trial->info.time < until - 1e-9) {
        stepped = world_step(trial->world, NULL, &failure);
        world_info(trial->world, &trial->info);
        ok = !stepped || trial->info.trouble.count > 0 ||
             look(trial, until, trial->info.time >= until - 1e-9, error);
        if (ok && interrupted())
            ok = error_set(error, "stopped");
    }
    if (ok && !stepped && !in_trouble(trial))
        ok = error_set(error, "%s", failure.message);
    return ok;
}

/* Simulates `until` (s), and fills in the row's steps, finder and outcome. The first trouble ends the
   trial without going back: found by the sentinel, or by one of STABLE_LOOKS looks, evenly spaced in time.
   A `whole` trial goes on after a look's finding, to learn if the sentinel finds the trouble too. Returns
   false with the reason if the failure is not the fluid's: memory, a signal. A GPU backend needs a current
   context. */
static bool stable_trial(const Scene *scene, double until, bool whole, StableRow *row, Error *error)
{
    Trial trial = {.scene = scene, .whole = whole, .world = world_create(&scene->world, error)};
    if (!trial.world)
        return false;
    world_info(trial.world, &trial.info);
    bool ok = run(&trial, until, error);
    row->steps = trial.info.step;
    outcome_judge(&trial.history, &row->outcome);
    row->finder = row->outcome.kind == OUTCOME_HOLDS ? FOUND_BY_NOBODY
                  : trial.history.trouble.ended      ? FOUND_BY_SENTINEL
                  : whole                            ? FOUND_BY_LOOKS
                                                     : FOUND_BY_LOOK;
    world_destroy(trial.world);
    if (ok && row->outcome.kind == OUTCOME_NONE) /* memory was short */
        ok = error_set(error, "%s", row->outcome.words);
    return ok;
}

const int stable_above[STABLE_ABOVE] = {1, 3, 5, 8};

/* State of a search. */
typedef struct Bracket {
    StableTry *attempt;
    void *context;
    int holds, fails;  /* rungs */
    bool held, failed; /* true if the rung is known */
    int highest;       /* rung that held from some start */
} Bracket;

/* Tries a rung from `starts` starts, until one fails. Returns the failure's outcome, else the last
   outcome. */
static bool ask(Bracket *b, int rung, int starts, bool whole, StableFound *found)
{
    for (int start = 0; start < starts; start++) {
        if (!b->attempt(b->context, rung, start, whole, found))
            return false;
        if (found->kind != OUTCOME_HOLDS)
            return true;
        b->highest = rung > b->highest ? rung : b->highest;
    }
    return true;
}

static bool try_rung(Bracket *b, int rung)
{
    StableFound found;
    if (!ask(b, rung, 1, false, &found))
        return false;
    if (found.kind == OUTCOME_HOLDS) {
        b->holds = rung;
        b->held = true;
    } else {
        b->fails = rung;
        b->failed = true;
    }
    return true;
}

/* Moves by factors of two until one rung holds and one fails, or the ends are reached. */
static bool enclose(Bracket *b, int first, int most, int lowest)
{
    bool ok = try_rung(b, first);
    while (ok && !b->failed && b->holds < most)
        ok = try_rung(b, b->holds + STABLE_RUNGS < most ? b->holds + STABLE_RUNGS : most);
    while (ok && !b->held && b->fails > lowest)
        ok = try_rung(b, b->fails - STABLE_RUNGS);
    return ok;
}

/* Moves down until chance decides no more: a rung with a failure at or below it is not accepted. */
static bool settle(Bracket *b, int lowest)
{
    static const int below[] = {0, 1, STABLE_BELOW}, starts[] = {STABLE_STARTS, STABLE_STARTS, 1};
    for (bool all = false; b->held && !all;) {
        all = true;
        const int rung = b->holds;
        for (int k = 0; all && k < 3; k++) {
            StableFound found;
            if (!ask(b, rung - below[k], starts[k], false, &found))
                return false;
            all = found.kind == OUTCOME_HOLDS;
            if (all)
                continue;
            b->fails = rung - below[k];
            b->failed = true;
            b->holds = b->fails - 1;
            b->held = b->holds >= lowest;
        }
    }
    return true;
}

int stable_sample(const StableSearch *search, int sample)
{
    return search->rung + (search->end == STABLE_NEVER ? sample * STABLE_RUNGS : stable_above[sample]);
}

/* Samples the outcomes above the largest step. */
static bool look_above(Bracket *b, int most, StableSearch *search)
{
    for (int i = 0; i < STABLE_ABOVE; i++) {
        const int rung = stable_sample(search, i);
        search->above[i] = (StableFound){.kind = OUTCOME_NONE};
        if (rung <= most && !ask(b, rung, STABLE_STARTS, search->end != STABLE_NEVER, &search->above[i]))
            return false;
    }
    search->again = b->highest > search->rung ? b->highest : search->rung;
    return true;
}

bool stable_search(StableTry *attempt, void *context, int first, int most, StableSearch *search)
{
    first = first < most ? first : most;
    const int lowest = first - STABLE_DOWN;
    Bracket b = {.attempt = attempt, .context = context, .highest = lowest - 1};
    bool ok = enclose(&b, first, most, lowest);
    while (ok && b.held && b.failed && b.fails > b.holds + 1)
        ok = try_rung(&b, b.holds + (b.fails - b.holds) / 2);
    if (!ok || !settle(&b, lowest))
        return false;
    search->end = !b.held ? STABLE_NEVER : !b.failed ? STABLE_ALWAYS : STABLE_FOUND;
    search->rung = b.held ? b.holds : b.fails;
    return look_above(&b, most, search);
}

/* ---- one search ---- */

typedef struct SearchWorker {
    const StablePlan *plan;
    const Trials *rows; /* known trials */
    int number;
    StableCell cell;
    Trials *made; /* new trials are made, sent and added here (equal to `rows`); NULL: no new trials */
    int pipe;
    Headless **context;
    int threads; /* per trial */
    Error *error;
} SearchWorker;

/* Message of a process, one per write: shorter than PIPE_BUF, so that writes are atomic. */
typedef enum Said { SAID_TRIAL, SAID_CELL, SAID_FAILURE } Said;

typedef struct TrialMessage {
    Said said;
    int cell;
    StableRow row;
    Error error;
} TrialMessage;

static bool tell(const SearchWorker *seeker, const TrialMessage *message)
{
    _Static_assert(sizeof *message < 4096, "a write of it is not torn");
    return write(seeker->pipe, message, sizeof *message) == (ssize_t)sizeof *message;
}

static bool make_trial(const SearchWorker *seeker, Scene *scene, bool whole, StableRow *row)
{
    TrialMessage message = {.said = SAID_TRIAL, .cell = seeker->number};
    if (world_on_gpu(&scene->world) && !*seeker->context &&
        !(*seeker->context = headless_create(seeker->plan->args->gpu, seeker->error)))
        return false;
    *world_threads(&scene->world) = seeker->threads;
    if (!stable_trial(scene, seeker->plan->time, whole, row, seeker->error))
        return false;
    message.row = *row;
    if (!trials_add(seeker->made, row, NULL))
        return error_set(seeker->error, "no memory for the trials");
    return tell(seeker, &message) || error_set(seeker->error, "a trial cannot be told (%s)", strerror(errno));
}

/* Difference of jitter between successive starts, spacings: physically the same start, apart from chance. */
static const double START = 1e-3;

static bool try_cell_rung(void *context, int rung, int start, bool whole, StableFound *found)
{
    Scene scene;
    const SearchWorker *seeker = context;
    const StableSeries *series = &seeker->plan->series[seeker->cell.series];
    char rest[64];
    StableRow row = {.rung = rung, .step = stable_step(rung)};
    if (!stable_scene(seeker->plan, seeker->cell, &rung, &scene, seeker->error))
        return false;
    scene.world.jitter += (scene.world.jitter < 0.25 ? START : -START) * start;
    snprintf(rest, sizeof rest, "%s %.9g %d", SLOSH_VERSION, seeker->plan->time, (int)STABLE_LOOKS);
    row.key = run_key_text(RUN_KEY, rest);
    if (!run_key_scene(&scene, false, &row.key, seeker->error))
        return false;
    const StableRow *there = trials_find(seeker->rows, row.key);
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

static bool seek(SearchWorker *seeker, StableSearch *search)
{
    Scene scene;
    int first, most;
    seeker->cell = stable_cell(seeker->plan, seeker->number);
    if (!stable_scene(seeker->plan, seeker->cell, NULL, &scene, seeker->error))
        return false;
    stable_range(seeker->plan, &scene, &first, &most);
    return stable_search(try_cell_rung, seeker, first, most, search);
}

bool stable_recall(const StablePlan *plan, int cell, const Trials *rows, StableSearch *search, Error *error)
{
    SearchWorker seeker = {.plan = plan, .rows = rows, .number = stable_searched(plan, cell), .error = error};
    return seek(&seeker, search);
}

/* ---- the processes ---- */

/* Takes cells until none is left. Results go through the pipe; the exit code is 0. */
static void work(const StablePlan *plan, Trials *rows, int pipe, int *next, int threads)
{
    Headless *context = NULL;
    const int all = stable_cells(plan);
    for (int number; !interrupted() && (number = __atomic_fetch_add(next, 1, __ATOMIC_RELAXED)) < all;) {
        TrialMessage message = {.said = SAID_CELL, .cell = number};
        StableSearch search;
        SearchWorker seeker = {.plan = plan,
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

typedef struct Workers {
    const StablePlan *plan;
    Trials *rows;
    const char *csv;
    int count, pipe, *next;
    pid_t *pid;
    int done;    /* cells */
    int *trials; /* count per cell */
    bool dirty;  /* true: some rows are not in the file yet */
    double wrote_ms;
    char reported[1024]; /* the last failure, to report each once */
} Workers;

static bool start(Workers *crew, Error *error)
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

static bool keep(Workers *crew, bool now, Error *error)
{
    static const double EVERY_MS = 200;
    if (!crew->dirty || (!now && wall_ms() < crew->wrote_ms + EVERY_MS))
        return true;
    crew->dirty = false;
    const bool ok = trials_keep(crew->rows, crew->csv, NULL, error);
    crew->wrote_ms = wall_ms();
    return ok;
}

static bool take(Workers *crew, const TrialMessage *message, Error *error)
{
    if (message->said == SAID_TRIAL) {
        crew->trials[message->cell]++;
        crew->dirty = true;
        return trials_add(crew->rows, &message->row, NULL) || error_set(error, "no memory for the trials");
    }
    crew->done++;
    crew->trials[message->cell] = 0;
    if (message->said == SAID_FAILURE && strcmp(crew->reported, message->error.message) != 0) {
        snprintf(crew->reported, sizeof crew->reported, "%s", message->error.message);
        fprintf(stderr, "not searched: %s\n", crew->reported);
    }
    return true;
}

/* A search takes about twenty trials. */
static double share(const Workers *crew)
{
    const int cells = stable_cells(crew->plan);
    double done = crew->done;
    for (int c = 0; c < cells; c++)
        done += crew->trials[c] < 18 ? 0.05 * crew->trials[c] : 0.9;
    return done / cells;
}

/* Reads messages until all processes have closed the pipe. Returns false if a trial cannot be kept, or
   after a signal. */
static bool listen_to(Workers *crew, Progress *progress, Error *error)
{
    struct pollfd ready = {.fd = crew->pipe, .events = POLLIN};
    TrialMessage message;
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
static bool end(Workers *crew, bool ok, Error *error)
{
    TrialMessage message;
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

bool stable_run(const StablePlan *plan, Trials *rows, const char *csv, Error *error)
{
    Workers crew = {.plan = plan, .rows = rows, .csv = csv, .pipe = -1, .wrote_ms = wall_ms()};
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
