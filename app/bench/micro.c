#include "app/bench/bench.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "sim/world.h"

#include <math.h>
#include <string.h>

enum { ROUNDS_LEAST = 3, ROUNDS_MOST = 100 };

static const double enough_ms = 1000; /* for all rounds of a state */

static double micro_copy(const Ceilings *ceilings, double bytes)
{
    double best = ceilings->copy[ceilings->copies - 1].rate;
    for (int k = 0; k < ceilings->copies; k++)
        if ((double)ceilings->copy[k].bytes >= bytes)
            best = fmax(best, ceilings->copy[k].rate);
    return best;
}

/* Lower bound of the time by each limit, s. */
static void least_times(const MicroPart *part, double particles, double pairs, const Ceilings *ceilings,
                        double seconds[MICRO_LIMIT_COUNT])
{
    const double streamed = part->stream * particles + part->stream_a_pair * pairs;
    seconds[MICRO_MEMORY] = streamed / micro_copy(ceilings, streamed);
    seconds[MICRO_CACHE] = part->pair.gather * pairs / micro_copy(ceilings, 0);
    seconds[MICRO_FLOPS] = part->pair.flops * pairs / ceilings->fused.rate;
}

static MicroFigure figure_of(const MicroPart *part, double particles, double pairs, double ms,
                             const Ceilings *ceilings)
{
    double least[MICRO_LIMIT_COUNT];
    const double seconds = 1e-3 * ms, bytes_a_pair = part->stream_a_pair + part->pair.gather;
    MicroFigure figure = {.name = part->name,
                          .pairs = part->pairs,
                          .pair = part->pair,
                          .bytes_per_particle = part->stream,
                          .bytes_per_pair = bytes_a_pair,
                          .ms = ms,
                          .particle_steps_per_second = particles / seconds};
    figure.bytes_per_second = (part->stream * particles + bytes_a_pair * pairs) / seconds;
    if (part->pairs) {
        figure.pairs_per_second = pairs / seconds;
        figure.flops_per_second = part->pair.flops * pairs / seconds;
        figure.flops_share = figure.flops_per_second / ceilings->fused.rate;
    }
    least_times(part, particles, pairs, ceilings, least);
    for (int k = 0; k < MICRO_LIMIT_COUNT; k++)
        figure.limit = least[k] > least[figure.limit] ? (MicroLimit)k : figure.limit;
    figure.share = least[figure.limit] / seconds;
    return figure;
}

/* Runs all parts in the order of a substep; keeps the least time of each. */
static void run_round(World *world, const MicroPart *parts, int count, double ms[MICRO_PARTS_MAX])
{
    for (int k = 0; k < count; k++) {
        const double began = wall_ms();
        world_micro_run(world, &parts[k]);
        ms[k] = fmin(ms[k], wall_ms() - began);
    }
}

static int run_rounds(World *world, int rounds, const MicroPart *parts, int count, double ms[MICRO_PARTS_MAX])
{
    double unused[MICRO_PARTS_MAX] = {0};
    int done = 0;
    run_round(world, parts, count, unused);
    for (int k = 0; k < count; k++)
        ms[k] = HUGE_VAL;
    for (const double began = wall_ms(); !interrupted() && done < (rounds ? rounds : ROUNDS_MOST); done++) {
        if (!rounds && done >= ROUNDS_LEAST && wall_ms() - began > enough_ms)
            break;
        run_round(world, parts, count, ms);
    }
    return done;
}

static bool measure_state(const MicroSetup *setup, World *world, double asked, const Ceilings *ceilings,
                          MicroResult *result, Error *error)
{
    WorldInfo info;
    WorldSums sums;
    MicroPart parts[MICRO_PARTS_MAX];
    double ms[MICRO_PARTS_MAX];
    world_info(world, &info);
    *result = (MicroResult){.threads = info.threads,
                            .particles = info.count,
                            .time = info.time,
                            .asked = asked,
                            .count = world_micro_parts(world, parts)};
    snprintf(result->scene, sizeof result->scene, "%s", setup->scene->path);
    snprintf(result->method, sizeof result->method, "%s", setup->scene->world.method);
    result->rounds = run_rounds(world, setup->rounds, parts, result->count, ms);
    if (result->rounds == 0)
        return error_set(error, "stopped before a round was measured");
    if (!world_micro_sound(world))
        return error_set(error, "no memory for lists of neighbours; use fewer particles");
    world_sums(world, &sums);
    result->neighbours_mean = sums.neighbours_mean;
    for (int k = 0; k < result->count; k++) {
        result->least_ms += (1 + ROUNDS_LEAST) * ms[k];
        result->figures[k] = figure_of(&parts[k], (double)info.count,
                                       (double)info.count * sums.neighbours_mean, ms[k], ceilings);
    }
    return true;
}

/* Steps until `from`, or until the wall time limit. Returns false if the simulation failed. */
static bool advance(World *world, double from, double until_ms, Error *error)
{
    WorldInfo info;
    for (world_info(world, &info); info.time < from && wall_ms() < until_ms && !interrupted();
         world_info(world, &info))
        if (!world_step(world, NULL, error))
            return false;
    return true;
}

static bool ceilings_ready(const World *world, Ceilings *ceilings, Error *error)
{
    MicroPart parts[MICRO_PARTS_MAX];
    if (world_micro_parts(world, parts) == 0)
        return error_set(error, "the passes of this backend cannot be run alone");
    return ceilings->copies > 0 || world_micro_ceilings(world, ceilings) ||
           error_set(error, "no memory for the copy that the passes are held against");
}

bool micro_measure(const MicroSetup *setup, Ceilings *ceilings, MicroResult results[2], int *count,
                   Error *error)
{
    *count = 0;
    const double began = wall_ms();
    World *world = world_create(&setup->scene->world, error);
    const double made = wall_ms() - began;
    bool ok = world && ceilings_ready(world, ceilings, error);
    const double until = wall_ms() + 1e3 * setup->seconds;
    ok = ok && measure_state(setup, world, 0, ceilings, &results[0], error);
    *count += ok;
    results[0].least_ms += made;
    if (ok && setup->from > 0) {
        ok = advance(world, setup->from, until, error) &&
             measure_state(setup, world, setup->from, ceilings, &results[1], error);
        *count += ok;
    }
    world_destroy(world);
    return ok;
}

static const char *const limit_names[] = {
    [MICRO_MEMORY] = "copy", [MICRO_CACHE] = "cache", [MICRO_FLOPS] = "flops"};

static const char *micro_limit_name(MicroLimit limit)
{
    return limit_names[limit];
}

void micro_print_ceilings(const Ceilings *ceilings, int threads, FILE *file)
{
    const CopyCeiling *cache = ceilings->copy, *memory = &ceilings->copy[ceilings->copies - 1];
    fprintf(file, "%s, %d thread%s\n", bench_processor(), threads, plural((size_t)threads));
    fprintf(file, "  a copy: %.1f GB/s of %zu kB, %.1f GB/s of %zu MB\n", 1e-9 * cache->rate,
            cache->bytes / 1000, 1e-9 * memory->rate, memory->bytes / 1000000);
    fprintf(file,
            "  multiply and add: %.1f Gflop/s of %d bits as the pair loops do it, %.1f of %d bits fused\n\n",
            1e-9 * ceilings->multiply_add.rate, ceilings->multiply_add.bits, 1e-9 * ceilings->fused.rate,
            ceilings->fused.bits);
}

static void print_figure(const MicroFigure *f, FILE *file)
{
    char pairs[64] = "", flops[64] = "";
    if (f->pairs) {
        snprintf(pairs, sizeof pairs, "%.4g", 1e-6 * f->pairs_per_second);
        snprintf(flops, sizeof flops, "%.3g", 1e-9 * f->flops_per_second);
    }
    fprintf(file, "  %-12s %9.3f %11.4g %9s", f->name, f->ms, 1e-6 * f->particle_steps_per_second,
            f->pairs ? pairs : "-");
    if (f->pairs)
        fprintf(file, " %7.0f %6d %8s %5.1f%%", f->bytes_per_pair, f->pair.flops, flops,
                100 * f->flops_share);
    else
        fprintf(file, " %7s %6s %8s %6s", "-", "-", "-", "-");
    fprintf(file, " %7.0f %7.3g %6.1f%% of %s\n", f->bytes_per_particle, 1e-9 * f->bytes_per_second,
            100 * f->share, micro_limit_name(f->limit));
}

static void print_head(const MicroResult *r, FILE *file)
{
    fprintf(file, "%s%s%s: %zu particle%s, %.1f neighbours, %s, ", r->scene, r->swept[0] ? ", " : "",
            r->swept, r->particles, plural(r->particles), r->neighbours_mean, r->method);
    if (r->asked <= 0)
        fprintf(file, "at its start\n");
    else if (r->time < r->asked)
        fprintf(file, "at %.3g s: the limit of --seconds came before %g s\n", r->time, r->asked);
    else
        fprintf(file, "at %.3g s\n", r->time);
}

void micro_print(const MicroResult *r, FILE *file)
{
    if (r->left_out[0]) {
        fprintf(file, "%s%s%s: left out: %s\n\n", r->scene, r->swept[0] ? ", " : "", r->swept, r->left_out);
        return;
    }
    print_head(r, file);
    fprintf(file, "  %-12s %9s %11s %9s %7s %6s %8s %6s %7s %7s %7s\n", "pass", "ms", "M part./s",
            "M pairs/s", "bytes", "flops", "Gflop/s", "fused", "bytes", "GB/s", "limit");
    fprintf(file, "  %-12s %9s %11s %9s %7s %6s %8s %6s %7s\n", "", "", "", "", "a pair", "a pair", "",
            "share", "a part.");
    for (int k = 0; k < r->count; k++)
        print_figure(&r->figures[k], file);
    fputc('\n', file);
}

static json_t *copies_json(const Ceilings *ceilings)
{
    json_t *copies = json_array();
    for (int k = 0; k < ceilings->copies; k++)
        json_array_append_new(copies, json_pack("{s:I, s:f}", "bytes", (json_int_t)ceilings->copy[k].bytes,
                                                "bytes_per_second", ceilings->copy[k].rate));
    return copies;
}

static json_t *flops_json(const FlopCeiling *ceiling)
{
    return json_pack("{s:i, s:f}", "bits", ceiling->bits, "flops_per_second", ceiling->rate);
}

static json_t *figure_json(const MicroFigure *f)
{
    json_t *json = json_pack("{s:s, s:f, s:f, s:f, s:f, s:s, s:f}", "name", f->name, "ms", f->ms,
                             "particle_steps_per_second", f->particle_steps_per_second, "bytes_per_particle",
                             f->bytes_per_particle, "bytes_per_second", f->bytes_per_second, "limit",
                             micro_limit_name(f->limit), "share", f->share);
    if (!json || !f->pairs)
        return json;
    json_object_update_new(json,
                           json_pack("{s:f, s:f, s:i, s:f, s:f}", "pairs_per_second", f->pairs_per_second,
                                     "bytes_per_pair", f->bytes_per_pair, "flops_per_pair", f->pair.flops,
                                     "flops_per_second", f->flops_per_second, "flops_share", f->flops_share));
    return json;
}

static json_t *passes_json(const MicroResult *r)
{
    json_t *passes = json_array();
    for (int k = 0; k < r->count; k++)
        json_array_append_new(passes, figure_json(&r->figures[k]));
    return passes;
}

static json_t *result_json(const MicroResult *r, const Ceilings *ceilings)
{
    if (r->left_out[0])
        return json_pack("{s:s, s:s, s:s}", "scene", r->scene, "swept", r->swept, "left_out", r->left_out);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:i, s:s, s:s, s:s, s:I, s:f, s:f, s:f, s:i}", "scene", r->scene, "backend", "cpu",
        "method", r->method, "threads", r->threads, "processor", bench_processor(), "compiler",
        bench_compiler, "options", bench_options, "particles", (json_int_t)r->particles, "time", r->time,
        "time_asked", r->asked, "neighbours_mean", r->neighbours_mean, "rounds", r->rounds);
    json_t *more = json_pack("{s:o, s:o, s:o, s:o}", "copy", copies_json(ceilings), "multiply_add",
                             flops_json(&ceilings->multiply_add), "fused", flops_json(&ceilings->fused),
                             "passes", passes_json(r));
    if (json && more && r->swept[0])
        json_object_set_new(json, "swept", json_string(r->swept));
    if (json)
        json_object_update_new(json, more);
    return json;
}

bool micro_write_json(const MicroResult *results, size_t count, const Ceilings *ceilings, const char *path,
                      Error *error)
{
    json_t *all = json_array();
    bool ok = true;
    for (size_t i = 0; i < count; i++)
        ok &= json_array_append_new(all, result_json(&results[i], ceilings)) == 0;
    const bool written = json_file_write(ok ? all : NULL, path, error);
    json_decref(all);
    return written;
}
