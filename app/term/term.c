#include "app/term/term.h"

#include "sim/base/time_table.h"

#include <string.h>

/* Fills in the index: "fluids[].viscosity" gives "fluids[1].viscosity". */
static void path_of(const Key *key, int element, char path[TERM_SIZE])
{
    const char *inner = strstr(key->path, "[]");
    if (inner)
        snprintf(path, TERM_SIZE, "%.*s[%d]%s", (int)(inner - key->path), key->path, element,
                 inner + strlen("[]"));
    else
        snprintf(path, TERM_SIZE, "%s", key->path);
}

/* True if the term is on in the struct at `base`. */
static bool is_on(const Key *key, const void *base, char value[TERM_SIZE])
{
    char text[TIME_TABLE_ROWS * 48];
    key_value_text(key, base, text, sizeof text);
    snprintf(value, TERM_SIZE, "%.*s", TERM_SIZE - 1, text);
    return strcmp(text, key->off) != 0;
}

int scene_terms(const Scene *scene, SceneTerm terms[TERMS_MAX])
{
    int count, found = 0;
    const Key *keys = scene_keys(&count);
    for (const Key *key = keys; key < keys + count; key++) {
        const KeyOwner *owner = key->off ? key_owner(key) : NULL;
        if (!key->off || (owner && !key_owner_used(owner, scene, true)))
            continue;
        const Key *list = key_list(key);
        for (int e = 0; e < (list ? key_list_count(list, scene) : 1) && found < TERMS_MAX; e++) {
            SceneTerm *term = &terms[found];
            const size_t at = list ? key_list_at(list, e) : 0;
            term->key = key;
            path_of(key, e, term->path);
            found += is_on(key, (const char *)scene + at, term->value);
        }
    }
    return found;
}
