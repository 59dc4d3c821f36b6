#include "app/recipe/recipe.h"

#include "app/base/suggest.h"
#include "app/yaml/yaml.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A preset being applied to a tree. */
typedef struct Making {
    Tree *tree;
    const Recipe *recipe;
    const char *said;
    int fluid;     /* index of the preset's fluid */
    char set[300]; /* the settings made, for people */
    Error *error;
} Making;

const char *recipe_choice(int index)
{
    return recipe_list[index].name;
}

static const Recipe *find(const char *name, size_t length)
{
    for (const Recipe *recipe = recipe_list; recipe->name; recipe++)
        if (strlen(recipe->name) == length && strncmp(recipe->name, name, length) == 0)
            return recipe;
    return NULL;
}

static bool unknown(const char *name, const char *said, Error *error)
{
    char all[200] = "";
    Suggestion near = suggest_for(name);
    for (const Recipe *recipe = recipe_list; recipe->name; recipe++) {
        suggest_offer(&near, recipe->name);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", *all ? ", " : "", recipe->name);
    }
    if (near.best)
        return error_set(error, "%s: there is no such preset; did you mean '%s'?", said, near.best);
    return error_set(error, "%s: there is no such preset; use %s", said, all);
}

/* ---- the fluid ---- */

static const char *name_of(const Node *fluid)
{
    const Node *name = fluid ? node_child(fluid, "name") : NULL;
    return name ? name->text : NULL;
}

static bool find_fluid(Making *making, const char *wanted)
{
    const Node *fluids = tree_at(making->tree, "fluids");
    const size_t count = fluids ? node_count(fluids) : 0;
    char *end;
    for (size_t i = 0; wanted && i < count; i++) {
        const char *name = name_of(node_element(fluids, i));
        if (name && strcmp(name, wanted) == 0) {
            making->fluid = (int)i;
            return true;
        }
    }
    making->fluid = wanted ? (int)strtol(wanted, &end, 10) : 0;
    if (making->fluid >= 0 && (size_t)making->fluid < count && (!wanted || (*wanted && !*end)))
        return true;
    return error_set(making->error,
                     "%s: the scene has no such fluid; name one of its %zu, or give its number from 0 on",
                     making->said, count);
}

/* True if a different fluid has the name. */
static bool name_is_taken(const Making *making, const char *name)
{
    const Node *fluids = tree_at(making->tree, "fluids");
    size_t place = 0;
    for (const Node *fluid = fluids ? fluids->first : NULL; fluid; fluid = fluid->next, place++) {
        const char *own = name_of(fluid);
        if ((int)place != making->fluid && own && strcmp(own, name) == 0)
            return true;
    }
    return false;
}

/* ---- its settings ---- */

static void drop(const Tree *tree, const char *path)
{
    const Node *node = tree_at(tree, path);
    char above[128];
    snprintf(above, sizeof above, "%.*s", (int)(strrchr(path, '.') - path), path);
    Node *parent = (Node *)tree_at(tree, above);
    for (Node **at = node && parent ? &parent->first : NULL; at && *at; at = &(*at)->next)
        if (*at == node) {
            *at = node->next;
            return;
        }
}

static void tell_set(Making *making, const char *path, const char *value)
{
    const size_t used = strlen(making->set);
    snprintf(making->set + used, sizeof making->set - used, "%s%s %s", used ? ", " : "", path, value);
}

static bool set(Making *making, const char *setting)
{
    static const char FLUID[] = "fluid.";
    char whole[200];
    const char *value = strchr(setting, '=') + 1;
    const bool of_fluid = strncmp(setting, FLUID, strlen(FLUID)) == 0;
    if (strncmp(setting, "fluid.name=", strlen("fluid.name=")) == 0 && name_is_taken(making, value))
        return true;
    if (of_fluid)
        snprintf(whole, sizeof whole, "fluids[%d].%s", making->fluid, setting + strlen(FLUID));
    else
        snprintf(whole, sizeof whole, "%s", setting);
    if (!of_fluid || strstr(setting, "density") || strstr(setting, "viscosity") ||
        strstr(setting, "tension")) {
        char path[64];
        snprintf(path, sizeof path, "%.*s", (int)strcspn(setting, "="), setting);
        tell_set(making, of_fluid ? path + strlen(FLUID) : path, value);
    }
    return tree_set(making->tree, whole, making->said, making->error);
}

/* Adds a note: "--preset honey: fluids[0] (water): density 1420, ...; the other fluids stay: --preset
   honey:NAME is of another one". */
static void tell(const Making *making, const char *name, bool chosen, Notes *notes)
{
    const Node *fluids = tree_at(making->tree, "fluids");
    const size_t others = fluids ? node_count(fluids) - 1 : 0;
    char which[64] = "", more[120] = "", without[160] = "";
    if (making->recipe->kind == RECIPE_FLUID) {
        snprintf(which, sizeof which, "fluids[%d]%s%.31s: ", making->fluid, name ? ", " : "",
                 name ? name : "");
        if (others > 0 && !chosen)
            snprintf(more, sizeof more, "; %zu other%s: --preset %s:FLUID is of one of them", others,
                     others == 1 ? " stays" : "s stay", making->recipe->name);
    }
    for (int i = 0; making->recipe->drops[i]; i++) {
        const size_t used = strlen(without);
        const char *dot = strrchr(making->recipe->drops[i], '.');
        snprintf(without + used, sizeof without - used, "%s%s", used ? ", " : "; by default: ", dot + 1);
    }
    notes_add(notes, "%s: %s%s%s%s", making->said, which, making->set, without, more);
}

bool recipe_apply(Tree *tree, const char *name, const char *said, Notes *notes, Error *error)
{
    const size_t length = strcspn(name, ":");
    Making making = {.tree = tree, .recipe = find(name, length), .said = said, .error = error};
    const char *wanted = name[length] ? name + length + 1 : NULL;
    char before[NOTE_SIZE] = "";
    if (!making.recipe)
        return unknown(name, said, error);
    if (making.recipe->kind == RECIPE_QUESTION && wanted)
        return error_set(error, "%s: it is of the solver, not of a fluid; leave :%s out", said, wanted);
    if (making.recipe->kind == RECIPE_FLUID && !find_fluid(&making, wanted))
        return false;
    const Node *fluids = tree_at(tree, "fluids");
    const char *own = fluids ? name_of(node_element(fluids, (size_t)making.fluid)) : NULL;
    snprintf(before, sizeof before, "%s", own ? own : "");
    for (int i = 0; making.recipe->drops[i]; i++)
        drop(tree, making.recipe->drops[i]);
    for (int i = 0; i < RECIPE_SETTINGS_MAX && making.recipe->set[i]; i++)
        if (!set(&making, making.recipe->set[i]))
            return false;
    tell(&making, *before ? before : NULL, wanted != NULL, notes);
    return true;
}

/* True if the row's path, with the fluid's number filled in, is the key of "path=value". */
static bool is_key(const char *row, const char *fluid, const char *setting)
{
    static const char FLUID[] = "fluid.";
    char path[128];
    const bool of_fluid = strncmp(row, FLUID, strlen(FLUID)) == 0;
    const char *rest = of_fluid ? row + strlen(FLUID) : row;
    if (of_fluid)
        snprintf(path, sizeof path, "fluids[%.8s].%.*s", fluid, (int)strcspn(rest, "="), rest);
    else
        snprintf(path, sizeof path, "%.*s", (int)strcspn(rest, "="), rest);
    return strlen(path) == strcspn(setting, "=") && strncmp(path, setting, strlen(path)) == 0;
}

bool recipe_concerns(const char *name, const char *setting)
{
    const Recipe *recipe = find(name, strcspn(name, ":"));
    const char *colon = strchr(name, ':'), *fluid = colon ? colon + 1 : "0";
    bool concerns = false;
    for (int i = 0; recipe && i < RECIPE_SETTINGS_MAX && recipe->set[i]; i++)
        concerns |= is_key(recipe->set[i], fluid, setting);
    for (int i = 0; recipe && recipe->drops[i]; i++)
        concerns |= is_key(recipe->drops[i], fluid, setting);
    return concerns;
}

void recipe_print(FILE *file)
{
    fprintf(file, "| preset | what it is | sets | drops | from |\n| --- | --- | --- | --- | --- |\n");
    for (const Recipe *recipe = recipe_list; recipe->name; recipe++) {
        fprintf(file, "| `%s` | %s |", recipe->name, recipe->help);
        for (int i = 0; i < RECIPE_SETTINGS_MAX && recipe->set[i]; i++)
            fprintf(file, "%s `%s`", i > 0 ? "," : "", recipe->set[i]);
        fprintf(file, " |");
        for (int i = 0; recipe->drops[i]; i++)
            fprintf(file, "%s `%s`", i > 0 ? "," : "", recipe->drops[i]);
        fprintf(file, " | %s |\n", recipe->source);
    }
}
