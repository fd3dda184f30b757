/**
   What the fuzz harnesses share.

   A harness is a file fuzz_NAME.c with fuzz_one(), made into two programs: one in which libFuzzer
   looks for bytes that break a claim, and one that plays the seeds in seeds/NAME, whatever the
   compiler.  What was found once is a seed from then on.

   Thread: one.
*/
#ifndef HOOKE_TESTS_FUZZ_FUZZ_H
#define HOOKE_TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The harness: do with these bytes what it is about.  The same bytes do the same thing, whatever
 * was done before. */
void fuzz_one(const uint8_t* bytes, size_t n_bytes);

/** What libFuzzer calls: fuzz_one(). */
int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t n_bytes);

/** Print a claim that does not hold and its place, and abort. */
_Noreturn void fuzz_fail(const char* claim, const char* file, int line);

#define FUZZ_CLAIM(claim) ((claim) ? (void)0 : fuzz_fail(#claim, __FILE__, __LINE__))

/** Bytes that are taken one by one; once they are over there are zeros. */
typedef struct {
  const uint8_t* at;
  size_t n_left;
} FuzzFeed;

/** Take a byte. */
uint32_t fuzz_byte(FuzzFeed* feed);

/** Take two bytes. */
uint32_t fuzz_word(FuzzFeed* feed);

/** Take bytes into memory of just that many, so that a read beyond them is seen; for free().
    @param most          At most so many are taken
    @param[out] n_bytes  How many were taken */
uint8_t* fuzz_take(FuzzFeed* feed, size_t most, size_t* n_bytes);

/** Copy bytes into memory of just that many; for free(). */
uint8_t* fuzz_copy(const uint8_t* bytes, size_t n_bytes);

/** A file of these bytes, which lives until the next one is asked for or the program ends.
    @return Its path */
const char* fuzz_file(const uint8_t* bytes, size_t n_bytes);

/**
   What a reader says of a file is one line "PATH…: found …, expected …", of printable bytes or
   UTF-8, in the room that it was given.

   @param error  Ends within its room
   @param has_line  Whether the number of a line of `bytes` stands behind the path
*/
void fuzz_claim_message(
    const char* error, const char* path, bool has_line, const uint8_t* bytes, size_t n_bytes);

#endif
