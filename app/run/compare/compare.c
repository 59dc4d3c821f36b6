#include "app/run/compare/compare.h"

#include "app/run/playback/playback.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "render/renderer.h"
#include "sim/flow/flow.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/start/start.h"
#include "sim/state.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A property in which panels may differ. */
typedef struct TitleFigure {
    const char *key;                                     /* key setting the property; "": none */
    void (*text)(const PanelFacts *facts, char out[64]); /* "": unknown */
} TitleFigure;

static void count_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "%zu particle%s", facts->particles, facts->particles == 1 ? "" : "s");
}

static void spacing_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "spacing %.3g mm", 1e3 * facts->spacing);
}

static void method_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "%s%s", facts->recorded ? "" : "method ", facts->recorded ? "" : facts->def->method);
}

static void step_text(const PanelFacts *facts, char out[64])
{
    const WorldDef *def = facts->def;
    if (facts->recorded)
        *out = 0;
    else if (def->step_mode == STEP_FIXED)
        snprintf(out, 64, "steps of %.3g ms", 1e3 * def->dt / def->substeps);
    else
        snprintf(out, 64, "steps by cfl");
}

/* The spacing is shown even if the name contains it: fills may have changed the value. */
static const TitleFigure figures[] = {
    {"", count_text}, {"", spacing_text}, {"solver.method", method_text}, {"", step_text}};

/* True if one of the lines sets the key. */
static bool says(const char *lines, const char *key)
{
    const size_t length = strlen(key);
    for (const char *at = lines; at && *at; at += strcspn(at, "\n"), at += *at != 0)
        if (length > 0 && strncmp(at, key, length) == 0 && at[length] == '=')
            return true;
    return false;
}

static void add(Title *title, const char *words)
{
    const size_t used = strlen(title->figures);
    if (*words)
        snprintf(title->figures + used, TITLE_SIZE - used, "%s%s", used ? ", " : "", words);
}

/* Notes a file without a state for the time, or a stopped solver. */
static void add_end(Title *title, const PanelFacts *facts)
{
    const double slack = 1e-9 * fmax(fabs(facts->wanted), 1);
    char words[64] = "";
    if (facts->failed)
        snprintf(words, sizeof words, "stopped at %.4g s", facts->time);
    else if (facts->recorded && facts->wanted > facts->last + slack)
        snprintf(words, sizeof words, "ends at %.4g s", facts->last);
    else if (facts->recorded && facts->wanted < facts->first - slack)
        snprintf(words, sizeof words, "begins at %.4g s", facts->first);
    else if (!facts->recorded && facts->time < facts->wanted - slack)
        snprintf(words, sizeof words, "now at %.4g s", facts->time);
    add(title, words);
}

void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title)
{
    const PanelFacts *own = &facts[panel];
    snprintf(title->words, sizeof title->words, "%s", *own->words ? own->words : unnamed);
    *title->figures = 0;
    add_end(title, own);
    for (size_t f = 0; f < sizeof figures / sizeof *figures; f++) {
        char text[64], other[64];
        bool differs = false;
        figures[f].text(own, text);
        for (int i = 0; i < count; i++) {
            figures[f].text(&facts[i], other);
            differs |= *other && strcmp(text, other) != 0;
        }
        if (differs && !says(own->said, figures[f].key))
            add(title, text);
    }
}

bool compare_is_other(const ViewDef *view)
{
    return view->file || view->set || view->time >= 0;
}

bool compare_is_same(const ViewDef *a, const ViewDef *b)
{
    return strcmp(text_or_empty(a->file), text_or_empty(b->file)) == 0 &&
           strcmp(text_or_empty(a->set), text_or_empty(b->set)) == 0 &&
           (a->time == b->time || (a->time < 0 && b->time < 0));
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void compare_name(const ViewDef *view, char words[COMPARE_NAME_SIZE])
{
    size_t used = 0;
    snprintf(words, COMPARE_NAME_SIZE, "%.120s", name_of(text_or_empty(view->file)));
    used = strlen(words);
    if (view->time >= 0)
        used += (size_t)snprintf(words + used, COMPARE_NAME_SIZE - used, "%stime %.6g s", used ? ", " : "",
                                 view->time);
    for (const char *line = text_or_empty(view->set); *line && used < COMPARE_NAME_SIZE;) {
        const int length = (int)strcspn(line, "\n"), path = (int)strcspn(line, "=");
        used += (size_t)snprintf(words + used, COMPARE_NAME_SIZE - used, "%s%.*s %.*s", used ? ", " : "",
                                 path, line, length - path - 1, line + path + 1);
        line += length + (line[length] != 0);
    }
}

bool compare_settings(const SceneSettings *base, const ViewDef *view, int entry, CompareSettings *out,
                      Error *error)
{
    SceneSettings *settings = &out->settings;
    *settings = base ? *base : (SceneSettings){.count = 0};
    snprintf(out->set, sizeof out->set, "%s", text_or_empty(view->set));
    settings->compared_set = view->set;
    char *rest = out->set;
    for (char *line = strtok_r(out->set, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        const int at = settings->count;
        if (!scene_settings_add(settings, out->said[at], line, error))
            return false;
        snprintf(out->said[at], sizeof out->said[at], "views[%d].set %.150s", entry, line);
    }
    return true;
}

/* Scalars depending on the method's columns; births come from ids. */
enum { OWN_SCALARS = (PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1) & ~PARTICLE_SCALAR(SCALAR_BORN) };

unsigned compare_simulated_attributes(const WorldDef *def)
{
    WorldDef could = *def;
    could.acceleration = true;
    return renderer_attributes(NULL) & (columns_scalars(&could) | ~(unsigned)OWN_SCALARS);
}

size_t compare_simulated_particles(const WorldDef *def)
{
    WorldDef could = *def;
    could.pours = true;
    return flow_capacity(&could, seed_count(def, def->spacing));
}

bool compare_simulated_has(const WorldDef *def, const ViewDef *view, Error *error)
{
    const unsigned reads = renderer_attributes(view) & OWN_SCALARS;
    WorldDef could = *def;
    could.acceleration = true;
    const unsigned beside = reads & ~columns_scalars(&could); /* accelerations */
    could.acceleration = world_can(&could, error);
    const unsigned lacks = reads & ~columns_scalars(&could);
    if (lacks && !beside)
        return false; /* the error of world_can */
    return lacks == 0 || error_set(error, "method %s keeps no such scalar", could.method);
}

static bool blame(int entry, Error *error)
{
    const Error why = *error;
    return error_set(error, "views[%d].file: %s", entry, why.message);
}

/* True if only the name relative to the working directory exists, as in --set; scene files mean a name
   beside the scene. */
static bool is_elsewhere(const char *path, const char *name)
{
    return strcmp(path, name) != 0 && access(path, F_OK) != 0 && access(name, F_OK) == 0;
}

bool compare_open_file(const char *scene, const ViewDef *view, int entry, Recorded *out, Notes *notes,
                       Error *error)
{
    char path[1200];
    Notes own = {.count = 0};
    const char *name = view->file ? view->file : name_of(scene);
    if (!scene_relative_path(scene, name, path, error))
        return blame(entry, error);
    if (is_elsewhere(path, name))
        return error_set(error,
                         "views[%d].file: %.300s is not there: it is found from the scene's folder, not from "
                         "the present one, where there is a %.300s; write its whole path",
                         entry, path, name);
    if (!recorded_is_file(path))
        return error_set(
            error,
            "views[%d].file: %.300s is no recorded run; name one of `slosh run`, *.h5part, or particles of another program",
            entry, path);
    if (!recorded_open(path, NULL, out, &own, error))
        return blame(entry, error);
    for (int i = 0; i < own.count; i++)
        notes_add(notes, "%s", own.line[i]);
    if (recorded_has(out, view, error))
        return true;
    recorded_close(out);
    return blame(entry, error);
}

static const size_t KEPT_BYTES = 256U << 20; /* for steps of a run in memory */

/* One companion. */
typedef struct ComparedRun {
    ViewDef view; /* identifies the companion */
    bool is_run;  /* from a file */
    char words[COMPARE_NAME_SIZE];
    Scene scene; /* with the view's settings, or from the file */
    Recording recording;
    Upload *upload;
    Simulator *simulator;
    Recorded recorded; /* with its reader until compare_start */
    Prefetch *prefetch;
    PrefetchStatus at;
    double asked, lead; /* of the prefetch, s */
    ParticleBuffers state;
    bool taken;
    unsigned messages; /* count of reported messages */
    bool failed;       /* the last step of the file or the simulation failed; reported */
} ComparedRun;

static const ParticleBuffers NO_PARTICLES = {.box = {.orientation = {0, 0, 0, 1}}};

struct CompareRuns {
    int count;
    ComparedRun members[PANELS_MAX];
};

static bool is_run(const ComparedRun *member)
{
    return member->is_run;
}

/* ---- reading ---- */

static bool read_settings(const CompareSetup *setup, int entry, ComparedRun *member, Notes *notes,
                          Error *error)
{
    CompareSettings *joined = malloc(sizeof *joined);
    const char *path = setup->scene->path;
    Notes own = {.count = 0};
    if (!joined)
        return error_set(error, "no memory for %s", member->words);
    bool ok = compare_settings(setup->settings, &member->view, entry, joined, error);
    joined->settings.purpose = SCENE_FOR_WINDOW;
    ok = ok && scene_parse(path, setup->text, setup->size, &joined->settings, &member->scene, &own, error) &&
         recording_create(&member->recording, path, setup->text, setup->size, &joined->settings, error);
    for (int i = 0; ok && i < own.count; i++)
        if (!notes_have(notes, own.line[i]))
            notes_add(notes, "%s: %s", member->words, own.line[i]);
    free(joined);
    return ok;
}

static bool read_member(const CompareSetup *setup, int entry, ComparedRun *member, Notes *notes, Error *error)
{
    compare_name(&member->view, member->words);
    member->is_run = member->view.file || !setup->text;
    if (!is_run(member))
        return read_settings(setup, entry, member, notes, error);
    if (!compare_open_file(setup->scene->path, &member->view, entry, &member->recorded, notes, error))
        return false;
    member->scene = member->recorded.scene;
    return true;
}

static ComparedRun *find(const CompareRuns *compared, const ViewDef *view)
{
    for (int i = 0; compared && i < compared->count; i++)
        if (compare_is_same(&compared->members[i].view, view))
            return (ComparedRun *)&compared->members[i];
    return NULL;
}

/* Checks the memory for all companions together; the loader has checked each alone. */
static bool fit_together(const CompareRuns *compared, const Scene *scene, Error *error)
{
    const WorldDef *def = &scene->world;
    double particles = (double)flow_capacity(def, seed_count(def, def->spacing));
    for (int i = 0; i < compared->count; i++) {
        def = &compared->members[i].scene.world;
        if (!is_run(&compared->members[i]))
            particles += (double)flow_capacity(def, seed_count(def, def->spacing));
    }
    return scene_fits_memory(particles) ||
           error_set(error,
                     "what the views show has %.3g particles together, more than this machine can hold",
                     particles);
}

bool compare_read(const CompareSetup *setup, CompareRuns **out, Notes *notes, Error *error)
{
    const Scene *scene = setup->scene;
    CompareRuns *compared = *out = NULL;
    bool ok = true;
    for (int i = 0; ok && i < scene->view_count; i++) {
        const ViewDef *view = &scene->views[i];
        if (!compare_is_other(view) || find(compared, view))
            continue;
        if (!compared && !(compared = calloc(1, sizeof *compared)))
            return error_set(error, "no memory for what the views show");
        ComparedRun *member = &compared->members[compared->count++];
        member->view = *view;
        member->state = NO_PARTICLES;
        ok = read_member(setup, i, member, notes, error);
    }
    ok = ok && (!compared || !setup->text || fit_together(compared, scene, error));
    if (ok)
        *out = compared;
    else
        compare_destroy(compared);
    return ok;
}

WorldDef *compare_world_def(CompareRuns *compared, int index)
{
    for (int i = 0; compared && i < compared->count; i++)
        if (!is_run(&compared->members[i]) && index-- == 0)
            return &compared->members[i].scene.world;
    return NULL;
}

/* ---- start and end ---- */

static bool start_run(ComparedRun *member, const SimulatorSetup *how, Error *error)
{
    Recorded taken = member->recorded; /* the facts of the file are needed later */
    const PrefetchSetup setup = {
        .recorded = &taken, .attributes = ~0U, .bytes = KEPT_BYTES, .at_or_after = true, .wake = how->wake};
    member->asked = NAN;
    member->prefetch = prefetch_create(&setup, error);
    if (member->prefetch)
        member->recorded.reader = NULL;
    return member->prefetch != NULL;
}

static bool start_simulator(ComparedRun *member, const SimulatorSetup *how, Error *error)
{
    const WorldDef *def = &member->scene.world;
    if (!world_can(def, error))
        return false;
    if (!world_on_gpu(def) &&
        !(member->upload = upload_create(compare_simulated_particles(def),
                                         upload_attributes(compare_simulated_attributes(def)), error)))
        return false;
    SimulatorSetup setup = *how;
    setup.scene = &member->scene;
    setup.recording = &member->recording;
    setup.upload = member->upload;
    setup.timer = NULL;
    setup.follows = true;
    setup.until = member->view.time < 0 ? 0 : fmax(member->view.time, 1e-9);
    member->simulator = simulator_create(&setup, error);
    return member->simulator != NULL;
}

bool compare_start(CompareRuns *compared, const SimulatorSetup *how, Error *error)
{
    bool ok = true;
    for (int i = 0; compared && ok && i < compared->count; i++)
        ok = (is_run(&compared->members[i]) ? start_run : start_simulator)(&compared->members[i], how, error);
    return ok;
}

int compare_followers(const CompareRuns *compared, Simulator *out[SIMULATOR_FOLLOWERS])
{
    int count = 0;
    for (int i = 0; compared && i < compared->count && count < SIMULATOR_FOLLOWERS; i++)
        if (compared->members[i].simulator)
            out[count++] = compared->members[i].simulator;
    return count;
}

void compare_destroy(CompareRuns *compared)
{
    for (int i = 0; compared && i < compared->count; i++) {
        ComparedRun *member = &compared->members[i];
        simulator_destroy(member->simulator, 0);
        upload_destroy(member->upload);
        recording_destroy(&member->recording);
        prefetch_destroy(member->prefetch);
        recorded_close(&member->recorded);
    }
    free(compared);
}

/* ---- while it runs ---- */

/* True if the view overrides the setting. */
static bool has_own(const ComparedRun *member, const SimCommand *command)
{
    char path[SETTING_TEXT_SIZE];
    if (command->kind != SIM_SET && command->kind != SIM_VALUE)
        return false;
    sim_command_path(command, path);
    const size_t length = strlen(path);
    for (const char *line = text_or_empty(member->view.set); *line;
         line += strcspn(line, "\n"), line += *line != 0)
        if (strncmp(line, path, length) == 0 && line[length] == '=')
            return true;
    return false;
}

void compare_send(CompareRuns *compared, const SimCommand *command)
{
    for (int i = 0; compared && i < compared->count; i++) {
        const ComparedRun *member = &compared->members[i];
        if (member->simulator && !has_own(member, command))
            simulator_send(member->simulator, command);
    }
}

/* Sends the command once; the simulator itself reports if accelerations are impossible. */
void compare_want_accelerations(CompareRuns *compared, const ViewDef *view)
{
    const SimCommand command = {.kind = SIM_SET, .setting = "solver.acceleration=true"};
    ComparedRun *member = find(compared, view);
    if (!member || !member->simulator || member->scene.world.acceleration)
        return;
    member->scene.world.acceleration = true;
    simulator_send(member->simulator, &command);
}

static bool is_fresh(const ComparedRun *member)
{
    if (member->prefetch)
        return prefetch_has_new(member->prefetch);
    return simulator_on_gpu(member->simulator) ? simulator_fresh(member->simulator)
                                               : upload_has_new(member->upload);
}

bool compare_has_new(CompareRuns *compared)
{
    bool fresh = false;
    for (int i = 0; compared && i < compared->count; i++)
        fresh |= is_fresh(&compared->members[i]);
    return fresh;
}

/* Takes a run's state. The next picture is expected after the same interval as this one. */
static void take_run(ComparedRun *member, double time)
{
    Error error = {{0}};
    time = member->view.time >= 0 ? member->view.time : time;
    if (time != member->asked) {
        member->lead = time > member->asked ? time - member->asked : 0;
        member->asked = time;
        prefetch_seek(member->prefetch, time, member->lead);
    }
    if (!prefetch_status(member->prefetch, &member->at, &error)) {
        member->at.failed = true;
        snprintf(member->at.message, sizeof member->at.message, "%s", error.message);
    }
    member->taken |= prefetch_take(member->prefetch, &member->state);
}

/* Takes a simulated state. Without a world, its buffers and births are gone. */
static void take_simulated(ComparedRun *member)
{
    if (!simulator_on_gpu(member->simulator))
        member->taken = upload_take(member->upload, &member->state);
    else if (!(member->taken = simulator_share(member->simulator, renderer_attributes(NULL), &member->state)))
        member->state = NO_PARTICLES;
}

bool compare_take(CompareRuns *compared, double time)
{
    bool all = true;
    for (int i = 0; compared && i < compared->count; i++) {
        ComparedRun *member = &compared->members[i];
        if (member->prefetch)
            take_run(member, time);
        else
            take_simulated(member);
        all &= member->taken || member->failed || member->at.failed; /* failed companions are shown empty */
    }
    return all;
}

/* ---- contents ---- */

const ParticleBuffers *compare_state(const CompareRuns *compared, const ViewDef *view)
{
    const ComparedRun *member = find(compared, view);
    return member ? &member->state : NULL;
}

const WorldDef *compare_world(const CompareRuns *compared, const ViewDef *view)
{
    const ComparedRun *member = find(compared, view);
    return member ? &member->scene.world : NULL;
}

void compare_facts(const CompareRuns *compared, const ViewDef *view, PanelFacts *facts)
{
    const ComparedRun *member = find(compared, view);
    if (!member)
        return;
    *facts = (PanelFacts){.words = member->words,
                          .said = text_or_empty(member->view.set),
                          .def = &member->scene.world,
                          .particles = member->state.count,
                          .spacing = member->state.spacing,
                          .recorded = is_run(member),
                          .failed = member->failed && !is_run(member),
                          .time = member->state.time,
                          .first = member->at.first,
                          .last = member->at.last,
                          .wanted = is_run(member) ? member->asked : member->view.time};
}

bool compare_has_attributes(const CompareRuns *compared, const ViewDef *view, Error *error)
{
    const ComparedRun *member = find(compared, view);
    return !member || (is_run(member) ? recorded_has(&member->recorded, view, error)
                                      : compare_simulated_has(&member->scene.world, view, error));
}

bool compare_reload(CompareRuns *compared, Error *error)
{
    bool ok = true;
    for (int i = 0; compared && i < compared->count; i++)
        ok = ok &&
             (!compared->members[i].simulator || simulator_reload(compared->members[i].simulator, error));
    return ok;
}

static bool run_message(ComparedRun *member, char words[1280])
{
    const bool news = member->at.failed && !member->failed;
    member->failed = member->at.failed;
    if (news)
        snprintf(words, 1280, "%s: %s", member->words, member->at.message);
    return news;
}

static bool simulator_message(ComparedRun *member, char words[1280])
{
    SimulatorStatus status;
    simulator_status(member->simulator, &status);
    const bool news = status.messages != member->messages;
    member->messages = status.messages;
    member->failed = status.failed;
    if (news)
        snprintf(words, 1280, "%s: %s", member->words, status.message);
    return news;
}

bool compare_message(CompareRuns *compared, char words[1280])
{
    for (int i = 0; compared && i < compared->count; i++) {
        ComparedRun *member = &compared->members[i];
        if ((member->prefetch && run_message(member, words)) ||
            (member->simulator && simulator_message(member, words)))
            return true;
    }
    return false;
}
