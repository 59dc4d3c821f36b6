#include "app/beside/company.h"
#include "app/beside/beside.h"

#include "app/playback/reel.h"
#include "app/recording/recording.h"
#include "app/scene/scene.h"
#include "render/renderer.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"
#include "sim/world/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const size_t KEPT_BYTES = 256U << 20; /* for steps of a run in memory */

/* One companion. */
typedef struct Member {
    ViewDef view; /* identifies the companion */
    char words[BESIDE_WORDS];
    Scene scene; /* with the view's settings, or from the file */
    Recording recording;
    Upload *upload;
    Simulator *simulator;
    Recorded recorded; /* with its reader until company_start */
    Reel *reel;
    ReelStatus at;
    double asked, lead; /* of the reel, s */
    ParticleBuffers state;
    bool taken;
    unsigned messages; /* count of reported messages */
    bool failed;       /* the reel's last step or the simulation failed; reported */
} Member;

static const ParticleBuffers NO_PARTICLES = {.box = {.orientation = {0, 0, 0, 1}}};

struct Company {
    int count;
    Member members[PANELS_MAX];
};

static bool is_run(const Member *member)
{
    return *member->view.file != 0;
}

/* ---- reading ---- */

static bool read_settings(const CompanySetup *setup, int entry, Member *member, Notes *notes, Error *error)
{
    BesideSettings *beside = malloc(sizeof *beside);
    const char *path = setup->scene->path;
    Notes own = {.count = 0};
    if (!beside)
        return error_set(error, "no memory for %s", member->words);
    bool ok = beside_settings(setup->settings, &member->view, entry, beside, error);
    beside->settings.purpose = SCENE_FOR_WINDOW;
    ok = ok && scene_parse(path, setup->text, setup->size, &beside->settings, &member->scene, &own, error) &&
         recording_create(&member->recording, path, setup->text, setup->size, &beside->settings, error);
    for (int i = 0; ok && i < own.count; i++)
        if (!notes_have(notes, own.line[i]))
            notes_add(notes, "%s: %s", member->words, own.line[i]);
    free(beside);
    return ok;
}

static bool read_member(const CompanySetup *setup, int entry, Member *member, Notes *notes, Error *error)
{
    beside_words(&member->view, member->words);
    if (!is_run(member))
        return read_settings(setup, entry, member, notes, error);
    if (!beside_open_file(setup->scene->path, &member->view, entry, &member->recorded, notes, error))
        return false;
    member->scene = member->recorded.scene;
    return true;
}

static Member *find(const Company *company, const ViewDef *view)
{
    for (int i = 0; company && i < company->count; i++)
        if (beside_same(&company->members[i].view, view))
            return (Member *)&company->members[i];
    return NULL;
}

/* Checks the memory for all companions together; the loader has checked each alone. */
static bool fit_together(const Company *company, const Scene *scene, Error *error)
{
    const WorldDef *def = &scene->world;
    double particles = (double)flow_capacity(def, seed_count(def, def->spacing));
    for (int i = 0; i < company->count; i++) {
        def = &company->members[i].scene.world;
        if (!is_run(&company->members[i]))
            particles += (double)flow_capacity(def, seed_count(def, def->spacing));
    }
    return scene_fits_memory(particles) ||
           error_set(error,
                     "what the views show has %.3g particles together, more than this machine can hold",
                     particles);
}

bool company_read(const CompanySetup *setup, Company **out, Notes *notes, Error *error)
{
    const Scene *scene = setup->scene;
    Company *company = *out = NULL;
    bool ok = true;
    for (int i = 0; ok && i < scene->view_count; i++) {
        const ViewDef *view = &scene->views[i];
        if (!beside_is(view) || find(company, view))
            continue;
        if (!company && !(company = calloc(1, sizeof *company)))
            return error_set(error, "no memory for what the views show");
        Member *member = &company->members[company->count++];
        member->view = *view;
        member->state = NO_PARTICLES;
        ok = read_member(setup, i, member, notes, error);
    }
    ok = ok && (!company || !setup->text || fit_together(company, scene, error));
    if (ok)
        *out = company;
    else
        company_destroy(company);
    return ok;
}

WorldDef *company_world_def(Company *company, int index)
{
    for (int i = 0; company && i < company->count; i++)
        if (!is_run(&company->members[i]) && index-- == 0)
            return &company->members[i].scene.world;
    return NULL;
}

/* ---- start and end ---- */

static bool start_run(Member *member, const SimulatorSetup *how, Error *error)
{
    Recorded taken = member->recorded; /* the facts of the file are needed later */
    const ReelSetup setup = {
        .recorded = &taken, .attributes = ~0U, .bytes = KEPT_BYTES, .at_or_after = true, .wake = how->wake};
    member->asked = NAN;
    member->reel = reel_create(&setup, error);
    if (member->reel)
        member->recorded.reader = NULL;
    return member->reel != NULL;
}

static bool start_simulator(Member *member, const SimulatorSetup *how, Error *error)
{
    const WorldDef *def = &member->scene.world;
    if (!world_can(def, error))
        return false;
    if (!world_on_gpu(def) &&
        !(member->upload = upload_create(beside_simulated_room(def),
                                         upload_of_worlds(beside_simulated_attributes(def)), error)))
        return false;
    SimulatorSetup setup = *how;
    setup.scene = &member->scene;
    setup.recording = &member->recording;
    setup.upload = member->upload;
    setup.timer = NULL;
    setup.follows = true;
    member->simulator = simulator_create(&setup, error);
    return member->simulator != NULL;
}

bool company_start(Company *company, const SimulatorSetup *how, Error *error)
{
    bool ok = true;
    for (int i = 0; company && ok && i < company->count; i++)
        ok = (is_run(&company->members[i]) ? start_run : start_simulator)(&company->members[i], how, error);
    return ok;
}

int company_followers(const Company *company, Simulator *out[SIMULATOR_FOLLOWERS])
{
    int count = 0;
    for (int i = 0; company && i < company->count && count < SIMULATOR_FOLLOWERS; i++)
        if (company->members[i].simulator)
            out[count++] = company->members[i].simulator;
    return count;
}

void company_destroy(Company *company)
{
    for (int i = 0; company && i < company->count; i++) {
        Member *member = &company->members[i];
        simulator_destroy(member->simulator, 0);
        upload_destroy(member->upload);
        recording_destroy(&member->recording);
        reel_destroy(member->reel);
        recorded_close(&member->recorded);
    }
    free(company);
}

/* ---- while it runs ---- */

/* True if the view overrides the setting. */
static bool has_own(const Member *member, const char *setting)
{
    const size_t length = strcspn(setting, "=");
    for (const char *line = member->view.set; *line; line += strcspn(line, "\n"), line += *line != 0)
        if (strncmp(line, setting, length) == 0 && line[length] == '=')
            return true;
    return false;
}

void company_send(Company *company, const SimCommand *command)
{
    for (int i = 0; company && i < company->count; i++) {
        const Member *member = &company->members[i];
        if (member->simulator && !(command->kind == SIM_SET && has_own(member, command->setting)))
            simulator_send(member->simulator, command);
    }
}

/* Sends the command once; the simulator itself reports if accelerations are impossible. */
void company_want(Company *company, const ViewDef *view)
{
    const SimCommand command = {.kind = SIM_SET, .setting = "solver.acceleration=true"};
    Member *member = find(company, view);
    if (!member || !member->simulator || member->scene.world.acceleration)
        return;
    member->scene.world.acceleration = true;
    simulator_send(member->simulator, &command);
}

static bool is_fresh(const Member *member)
{
    if (member->reel)
        return reel_fresh(member->reel);
    return simulator_on_gpu(member->simulator) ? simulator_fresh(member->simulator)
                                               : upload_fresh(member->upload);
}

bool company_fresh(Company *company)
{
    bool fresh = false;
    for (int i = 0; company && i < company->count; i++)
        fresh |= is_fresh(&company->members[i]);
    return fresh;
}

/* Takes a run's state. The next picture is expected after the same interval as this one. */
static void take_run(Member *member, double time)
{
    Error error = {{0}};
    if (time != member->asked) {
        member->lead = time > member->asked ? time - member->asked : 0;
        member->asked = time;
        reel_seek(member->reel, time, member->lead);
    }
    if (!reel_status(member->reel, &member->at, &error)) {
        member->at.failed = true;
        snprintf(member->at.message, sizeof member->at.message, "%s", error.message);
    }
    member->taken |= reel_take(member->reel, &member->state);
}

/* Takes a simulated state. Without a world, its buffers and births are gone. */
static void take_simulated(Member *member)
{
    if (!simulator_on_gpu(member->simulator))
        member->taken = upload_take(member->upload, &member->state);
    else if (!(member->taken = simulator_share(member->simulator, renderer_attributes(NULL), &member->state)))
        member->state = NO_PARTICLES;
}

bool company_take(Company *company, double time)
{
    bool all = true;
    for (int i = 0; company && i < company->count; i++) {
        Member *member = &company->members[i];
        if (member->reel)
            take_run(member, time);
        else
            take_simulated(member);
        all &= member->taken || member->failed || member->at.failed; /* failed companions are shown empty */
    }
    return all;
}

/* ---- contents ---- */

const ParticleBuffers *company_state(const Company *company, const ViewDef *view)
{
    const Member *member = find(company, view);
    return member ? &member->state : NULL;
}

const WorldDef *company_world(const Company *company, const ViewDef *view)
{
    const Member *member = find(company, view);
    return member ? &member->scene.world : NULL;
}

void company_facts(const Company *company, const ViewDef *view, PanelFacts *facts)
{
    const Member *member = find(company, view);
    if (!member)
        return;
    *facts = (PanelFacts){.words = member->words,
                          .said = member->view.set,
                          .def = &member->scene.world,
                          .particles = member->state.count,
                          .spacing = member->state.spacing,
                          .recorded = is_run(member),
                          .failed = member->failed && !is_run(member),
                          .time = member->state.time,
                          .first = member->at.first,
                          .last = member->at.last,
                          .wanted = member->asked};
}

bool company_has(const Company *company, const ViewDef *view, Error *error)
{
    const Member *member = find(company, view);
    return !member || (is_run(member) ? recorded_has(&member->recorded, view, error)
                                      : beside_simulated_has(&member->scene.world, view, error));
}

bool company_reload(Company *company, Error *error)
{
    bool ok = true;
    for (int i = 0; company && i < company->count; i++)
        ok = ok && (!company->members[i].simulator || simulator_reload(company->members[i].simulator, error));
    return ok;
}

static bool run_message(Member *member, char words[1280])
{
    const bool news = member->at.failed && !member->failed;
    member->failed = member->at.failed;
    if (news)
        snprintf(words, 1280, "%s: %s", member->words, member->at.message);
    return news;
}

static bool simulator_message(Member *member, char words[1280])
{
    static SimulatorStatus status;
    simulator_status(member->simulator, &status);
    const bool news = status.messages != member->messages;
    member->messages = status.messages;
    member->failed = status.failed;
    if (news)
        snprintf(words, 1280, "%s: %s", member->words, status.message);
    return news;
}

bool company_message(Company *company, char words[1280])
{
    for (int i = 0; company && i < company->count; i++) {
        Member *member = &company->members[i];
        if ((member->reel && run_message(member, words)) ||
            (member->simulator && simulator_message(member, words)))
            return true;
    }
    return false;
}
