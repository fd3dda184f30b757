/** What sets a string in motion. */
#ifndef HOOKE_CORE_EXCITE_EXCITER_H
#define HOOKE_CORE_EXCITE_EXCITER_H

typedef enum {
  EXCITER_PLUCK,  /**< A finger or a pick */
  EXCITER_STRIKE, /**< A hammer with a felt */
  EXCITER_BOW     /**< A bow, as long as the key is down */
} Exciter;

#endif
