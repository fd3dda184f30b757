/**
   What is used of LAPACK.  Every matrix is column-major; every argument is passed by reference.
   What is written only, what is destroyed, and `info`, are as LAPACK has them: info = 0 is success,
   −i an illegal i-th argument (a bug of ours), > 0 a failure to converge or to factorise.

   To be included by the rooms of core/ that know LAPACK and by no other.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_LAPACK_H
#define HOOKE_CORE_ANALYSIS_MODES_LAPACK_H

#include <complex.h>

/* Eigenvalues wr + i wi of a, n × n, destroyed; with 'N' no vectors. */
void dgeev_(const char* jobvl,
            const char* jobvr,
            const int* n,
            double* a,
            const int* lda,
            double* wr,
            double* wi,
            double* vl,
            const int* ldvl,
            double* vr,
            const int* ldvr,
            double* work,
            const int* lwork,
            int* info);

/* Eigenvalues w, rising, and with 'V' vectors in a, of a symmetric, n × n. */
void dsyev_(const char* jobz,
            const char* uplo,
            const int* n,
            double* a,
            const int* lda,
            double* w,
            double* work,
            const int* lwork,
            int* info);

/* QR with column pivoting of a, m × n: R in its upper triangle, jpvt the columns from 1. */
void dgeqp3_(const int* m,
             const int* n,
             double* a,
             const int* lda,
             int* jpvt,
             double* tau,
             double* work,
             const int* lwork,
             int* info);

/* Singular values and vectors of a, m × n, m ≥ n, by one-sided Jacobi rotations. */
void dgejsv_(const char* joba,
             const char* jobu,
             const char* jobv,
             const char* jobr,
             const char* jobt,
             const char* jobp,
             const int* m,
             const int* n,
             double* a,
             const int* lda,
             double* sva,
             double* u,
             const int* ldu,
             double* v,
             const int* ldv,
             double* work,
             const int* lwork,
             int* iwork,
             int* info);

/* Solve a complex system, a n × n, destroyed. */
void zgetrf_(const int* m, const int* n, double complex* a, const int* lda, int* ipiv, int* info);
void zgetrs_(const char* trans,
             const int* n,
             const int* nrhs,
             const double complex* a,
             const int* lda,
             const int* ipiv,
             double complex* b,
             const int* ldb,
             int* info);

#endif
