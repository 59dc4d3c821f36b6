/* A single program per folder: tests/CMakeLists.txt renames the `main` of each tests/FOLDER/test_NAME.c
   to test_NAME_main and lists the function, so that `test_FOLDER NAME` runs the test. */
#ifndef SLOSH_TEST_PROGRAM_H
#define SLOSH_TEST_PROGRAM_H

typedef struct TestFile {
    const char *name;
    int (*run)(void);
} TestFile;

/* Of the folder, ended by a NULL name: made by tests/CMakeLists.txt. */
extern const TestFile test_files[];

/* What follows the name on the command line. */
extern int test_argc;
extern char **test_argv;

#endif
