/* Prints a tree as YAML. Comments and layout of the original text are lost. */
#ifndef SLOSH_YAML_PRINT_H
#define SLOSH_YAML_PRINT_H

#include "app/yaml/tree.h"

#include <stdio.h>

/* Prints a tree; reading the output gives the same tree. Values from the command line are followed by
   `said` as a comment. */
void tree_print(const Tree *tree, FILE *file);

/* Prints a node on one line: [1, {a: b}]. */
void node_print(const Node *node, FILE *file);

#endif
