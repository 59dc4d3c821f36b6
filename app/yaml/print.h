/* A tree as YAML again. What the file's own text had besides, its comments and its layout, is gone. */
#ifndef SLOSH_YAML_PRINT_H
#define SLOSH_YAML_PRINT_H

#include "app/yaml/tree.h"

#include <stdio.h>

/* Read again it gives the same tree. Behind a value that the command line said stands what its `said` is, as
   a comment. */
void tree_print(const Tree *tree, FILE *file);

/* The same of one node, on one line: [1, {a: b}]. */
void node_print(const Node *node, FILE *file);

#endif
