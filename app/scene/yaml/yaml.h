/* YAML text as a tree with the line and column of each node. The tree is read, changed by `--set`, printed,
   patched with comments kept, and its values read by the rows of the table of keys. Knows no scene.

   Not libfyaml's own document tree (tried with 0.7.12): it gives positions of scalars only, where messages
   need those of mappings and lists too. Its emitter kept one comment of seven of a small scene, and no
   layout. The tree is made of libfyaml's events; one arena frees all memory, also after an error. Aliases,
   tags, several documents and duplicate keys are refused. */
#ifndef APP_SCENE_YAML_YAML_H
#define APP_SCENE_YAML_YAML_H

#include "sim/base/key.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { TREE_DEPTH_MAX = 32 };

typedef enum YamlKind { NODE_SCALAR, NODE_MAPPING, NODE_SEQUENCE } YamlKind;

typedef struct YamlNode YamlNode;
struct YamlNode {
    YamlKind kind;
    bool plain;       /* scalar without quotes: may be a number, a boolean or empty */
    int line, column; /* counted from 1 */
    const char
        *said; /* setting on the command line: "--set path=value", "--backend cpu"; NULL: from the file */
    const char *text; /* scalar; NULL: empty */
    const char *key;  /* key of a child of a mapping */
    int key_line, key_column;
    YamlNode *first, *next; /* children; siblings, in text order */
};

typedef struct YamlTree {
    const char *path; /* for messages; not owned */
    int dimensions;   /* of the scene: 2 allows vectors of two numbers; 0 or 3: three */
    YamlNode *root;
    struct YamlBlock *blocks; /* owned: nodes and texts */
} YamlTree;

/* Returns zeroed memory living as long as the tree; NULL if memory is short. */
void *tree_alloc(YamlTree *tree, size_t size);
void tree_free(YamlTree *tree);

/* Child of a mapping by key, or of a sequence by index; NULL if there is none. */
const YamlNode *node_child(const YamlNode *mapping, const char *key);
const YamlNode *node_element(const YamlNode *sequence, size_t index);
size_t node_count(const YamlNode *node);

typedef struct YamlPathPart {
    long index; /* of a list, from 0; -1: a key */
    char key[64];
} YamlPathPart;

/* Takes the next part of a path like `fluids[0].density`; returns false if faulty. */
bool path_next(const char **path, YamlPathPart *part);

/* Returns the node at a path like `fluids[0].fill`, or its nearest ancestor, for messages. */
const YamlNode *tree_nearest(const YamlTree *tree, const char *path);

/* Returns the node at the exact path; NULL if there is none. The path ends in a key. */
const YamlNode *tree_at(const YamlTree *tree, const char *path);

/* Writes "place: message" and returns false. */
bool tree_error(const YamlTree *tree, const YamlNode *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same, at the position of the node's key if there is a key. */
bool tree_error_key(const YamlTree *tree, const YamlNode *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Reads trees from YAML: a whole text, or values of single settings. */

/* Reads a scene: one YAML document, a mapping. Returns false with "path:line:column: ..."; call tree_free
   in either case. */
bool tree_read(YamlTree *tree, const char *path, const char *bytes, size_t size, Error *error);

/* Sets "path=value", with a path like `fluids[0].density`. Missing mappings on the path are created, and
   an index one past the end of a list appends. `said` names the setting in messages, such as "--backend
   cpu", and must outlive the tree; NULL: "--set path=value". Returns false with "--set path=value: ...". */
bool tree_set(YamlTree *tree, const char *setting, const char *said, Error *error);

/* Reads one YAML document into nodes of the tree; `said` as in YamlNode. *root is NULL for an empty document.
   Returns false with a message naming the place. */
bool yaml_read(YamlTree *tree, const char *said, const char *bytes, size_t size, YamlNode **root,
               Error *error);

/* Reads a single value from YAML: from its node to the field of its key. */

/* Reads a number, curve, integer, boolean, text, choice, vector, colour, range or control points into
   `base` + the key's offset; `shown` is the key's path for messages. Returns false with "place: shown must
   be ...". */
bool value_read(const YamlTree *tree, const Key *key, const YamlNode *node, const char *shown, char *base,
                Error *error);

/* True if the number lies in the key's range. */
bool value_in_range(const Key *key, double number);

/* Prints a tree as YAML. Comments and layout of the original text are lost. */

/* Prints a tree; reading the output gives the same tree. Values from the command line are followed by
   `said` as a comment. */
void tree_print(const YamlTree *tree, FILE *file);

/* Prints a node on one line: [1, {a: b}]. */
void node_print(const YamlNode *node, FILE *file);

/* Writes settings into the text of a scene, keeping comments and layout. */

/* Returns the text with "path=value" written in, ended by a 0; the caller frees the text. Reading the
   result gives the same tree as tree_set on the given text. Returns NULL with the reason if the text is no
   scene or the setting has no place. An existing value is replaced in place, a new key is added to its
   mapping. If impossible, the block of the path's first key is rewritten without its comments: then *lost
   (may be NULL) becomes true. */
char *yaml_patch(const char *path, const char *text, size_t size, const char *setting, bool *lost,
                 Error *error);

#endif
