#include "core/harp/harp_group.h"

/* So that those of one key are not looked after together. */
enum { PHASE = 3 };

size_t harp_group_size(void) {
  return HARP_FOLLOWERS * chain_size(HARP_FOLLOWER_MASSES);
}

void harp_group_init(HarpString* leader, HarpString* followers, void* memory) {
  leader->followers = followers;
  for (uint32_t i = 0; i < HARP_FOLLOWERS; ++i) {
    harp_string_init(
        &followers[i], leader->patch, leader->voice.rate_hz, leader->key + PHASE * (i + 1),
        (char*)memory + i * chain_size(HARP_FOLLOWER_MASSES), HARP_FOLLOWER_MASSES, NULL);
  }
}

HarpString* harp_group_awake(const HarpString* leader, uint32_t i) {
  HarpString* const follower = leader->is_followed ? &leader->followers[i] : NULL;
  return follower && follower->voice.is_awake ? follower : NULL;
}

static bool is_followed(const HarpString* leader) {
  bool is_followed = false;
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    is_followed = is_followed || leader->followers[i].voice.is_awake;
  }
  return is_followed;
}

bool harp_group_is_awake(const HarpString* leader) {
  return leader->voice.is_awake || is_followed(leader);
}

bool harp_group_forget(HarpString* leader) {
  leader->is_followed = is_followed(leader);
  return !leader->is_followed;
}

/* What the leader's channel and key do to it they do to those that follow. */
static void follow(HarpString* follower, const HarpString* leader) {
  follower->key = leader->key;
  follower->semitones = leader->semitones;
  follower->lift = leader->lift;
  follower->touch = leader->touch;
  follower->leaned_on = leader->leaned_on;
}

/* Who was played in an earlier group stays where it is. */
static void place(HarpString* string, HarpMember member) {
  if (member.share > 0.0) {
    string->cents = member.cents;
    string->decay = member.decay;
  }
}

/* All go where the patch has them now. */
static void place_all(HarpString* leader, HarpMember members[HARP_MEMBERS]) {
  harp_members_place(leader->patch, leader->group, members);
  place(leader, members[0]);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    follow(&leader->followers[i], leader);
    place(&leader->followers[i], members[1 + i]);
  }
}

void harp_group_rest(HarpString* leader) {
  harp_string_rest(leader);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    harp_string_rest(&leader->followers[i]);
  }
  leader->is_followed = false;
  leader->group = (HarpGroup){0};
}

void harp_group_sleep(HarpString* leader) {
  voice_sleep(&leader->voice);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    voice_sleep(&leader->followers[i].voice);
  }
}

static Pluck share_of(Pluck pluck, double share) {
  pluck.amplitude *= share;
  return pluck;
}

/* Who is not played, but rings, has its damper lifted all the same. */
static void play(HarpString* follower, Pluck pluck, uint32_t n_glide) {
  if (pluck.amplitude == 0.0) {
    harp_string_retune(follower, n_glide);
  } else if (harp_string_ready(follower, n_glide)) {
    harp_string_play(follower, pluck, n_glide);
  }
}

void harp_group_play(HarpString* leader, Pluck pluck, uint32_t n_glide) {
  HarpMember members[HARP_MEMBERS];
  leader->group = leader->followers ? harp_members_group(leader->patch) : (HarpGroup){0};
  leader->is_followed = leader->is_followed || !harp_members_is_alone(leader->group);
  leader->lift = 1.0;
  place_all(leader, members);
  if (harp_string_ready(leader, n_glide)) {
    pluck.amplitude *= harp_string_gain(leader, members, share_of(pluck, members[0].share));
    harp_string_play(leader, share_of(pluck, members[0].share), n_glide);
  } else {
    pluck.amplitude = 0.0;
  }
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    play(&leader->followers[i], share_of(pluck, members[1 + i].share), n_glide);
  }
}

void harp_group_lift(HarpString* leader) {
  harp_string_lift(leader);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    harp_string_lift(&leader->followers[i]);
  }
}

void harp_group_retune(HarpString* leader, uint32_t n_glide) {
  HarpMember members[HARP_MEMBERS];
  place_all(leader, members);
  harp_string_retune(leader, n_glide);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    harp_string_retune(&leader->followers[i], n_glide);
  }
}

void harp_group_choke(HarpString* leader, uint32_t n_glide) {
  HarpMember members[HARP_MEMBERS];
  place_all(leader, members);
  harp_string_choke(leader, n_glide);
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    harp_string_choke(&leader->followers[i], n_glide);
  }
}

bool harp_group_wake(HarpString* leader, uint32_t n_glide) {
  HarpMember members[HARP_MEMBERS];
  leader->group = harp_group_is_awake(leader) ? leader->group : (HarpGroup){0};
  place_all(leader, members);
  return harp_string_wake(leader, n_glide);
}

void harp_group_report(const HarpString* leader, VoiceReport* report) {
  for (uint32_t i = 0; leader->is_followed && i < HARP_FOLLOWERS; ++i) {
    voice_report(&leader->followers[i].voice, report);
  }
}
