/* Types and macros of FMI 3.0.2 (https://fmi-standard.org/docs/3.0.2/) that the FMU uses. */
#ifndef GUDGEON_FMI3_H
#define GUDGEON_FMI3_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef double fmi3Float64;
typedef bool fmi3Boolean;
typedef const char *fmi3String;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
    fmi3String message);
typedef void (*fmi3IntermediateUpdateCallback)(void);

#if defined(_WIN32)
#define FMI3_EXPORT __declspec(dllexport)
#else
#define FMI3_EXPORT __attribute__((visibility("default")))
#endif

/* Define a function of FMI that this FMU does not support; it returns fmi3Error. */
#define FMI3_NONE(name) FMI3_EXPORT fmi3Status name(fmi3Instance instance) { return (void)instance, fmi3Error; }

#endif
