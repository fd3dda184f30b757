/** How loud a sound is to the ear, by ITU-R BS.1770. */
#ifndef HOOKE_TESTS_SUPPORT_LOUDNESS_H
#define HOOKE_TESTS_SUPPORT_LOUDNESS_H

#include <stddef.h>

/**
   The loudest 400 ms of a stereo sound at 48 kHz [LUFS]: K-weighted, the powers of both sides
   added.

   @param n  Frames; with less than 400 ms, as if silence followed
   @return −INFINITY for silence
*/
double loudness_lufs(const float* left, const float* right, size_t n);

/** The same at any rate [Hz]. */
double loudness_lufs_at(double rate_hz, const float* left, const float* right, size_t n);

#endif
