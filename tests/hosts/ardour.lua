-- What the tests do with Ardour's sessions; run by its ardour7-lua, or that of a later version.
--
--   ardour.lua make DIRECTORY TRACK=URI... [TRACK.preset=LABEL] [TRACK:LABEL=VALUE]... [TRACK@LABEL=S:VALUE,S:VALUE...]...
--       a new session, with a track for each plugin, a preset, values, and lanes of automation
--   ardour.lua check DIRECTORY
--       load it, tell what is in it, and save it again
--   ardour.lua live DIRECTORY TRACK@S...
--       play the song of each track from S seconds on, and end a note in all the ways that there are
--
-- What is told is a line of fields with bars between them: INSTRUMENT and HAS of what Ardour finds, PLUGIN, VALUE, LANE and
-- REGION of what is in a session, DID of a gesture.

local mode, directory = arg[1], arg[2]
local NAME, RATE = "song", 48000
local WAIT_S, STEP_S = 60, 0.05
local NOTE_END_S, REST_S = 2.3, 3.6 -- Where the first note of a song is over, and where all are
local METER = "Strings Sounding"
local BY_USER = ARDOUR.TransportRequestSource.TRS_UI

AudioEngine:set_backend("None (Dummy)", "", "")

local function say(...)
  local fields = { ... }
  for i, field in ipairs(fields) do fields[i] = tostring(field) end
  print(table.concat(fields, "|"))
end

-- Calls with each control of a plugin: its index among all ports, among controls, and whether it is an input
local function each_control(plugin, call)
  local n = 0
  for i = 0, plugin:parameter_count() - 1 do
    if plugin:parameter_is_control(i) then
      call(i, n, plugin:parameter_is_input(i))
      n = n + 1
    end
  end
end

local function find_control(plugin, label)
  local port, number
  each_control(plugin, function(i, n)
    if plugin:parameter_label(i) == label then port, number = i, n end
  end)
  assert(port, "there is no control " .. label)
  return port, number
end

local function automation_of(processor, port)
  local parameter = Evoral.Parameter(ARDOUR.AutomationType.PluginAutomation, 0, port)
  return processor:to_automatable():automation_control(parameter, false)
end

local function tell_lane(session, route, processor, plugin, port)
  local control = automation_of(processor, port)
  if control:isnil() or control:alist():isnil() then return end
  local points = ""
  for event in control:alist():list():events():iter() do
    points = points .. string.format(" %.4f:%.6g", event.when:samples() / session:nominal_sample_rate(), event.value)
  end
  if points ~= "" then
    say("LANE", route:name(), plugin:parameter_label(port), control:automation_state(), points)
  end
end

local function tell_track(session, route)
  local processor = route:the_instrument()
  if processor:isnil() then return end
  local plugin = processor:to_insert():plugin(0)
  say("PLUGIN", route:name(), plugin:unique_id(), processor:active(), plugin:last_preset().label, route:n_outputs():n_audio(),
        processor:to_insert():signal_latency())
  each_control(plugin, function(i, n, is_input)
    if is_input then
      local value = ARDOUR.LuaAPI.get_processor_param(processor, n, false)
      say("VALUE", route:name(), plugin:parameter_label(i), string.format("%.6g", value))
      tell_lane(session, route, processor, plugin, i)
    end
  end)
  local track = route:to_track()
  if track:isnil() then return end
  for region in track:playlist():region_list():iter() do
    say("REGION", route:name(), region:name(), region:position():samples(), region:length():samples(),
          ARDOUR.LuaAPI.note_list(region:to_midiregion():model()):size())
  end
end

local function tell(session)
  assert(session:unknown_processors():size() == 0, "there are unknown processors")
  for route in session:get_routes():iter() do tell_track(session, route) end
end

local function add_track(session, name, uri)
  local info = ARDOUR.LuaAPI.new_plugin_info(uri, ARDOUR.PluginType.LV2)
  assert(not info:isnil(), "Ardour does not find " .. uri)
  say("INSTRUMENT", name, info.name, info:is_instrument())
  for preset in info:get_presets():iter() do say("HAS", name, preset.label) end
  local midi, audio = ARDOUR.ChanCount(ARDOUR.DataType("midi"), 1), ARDOUR.ChanCount(ARDOUR.DataType("audio"), 2)
  session:new_midi_track(midi, audio, true, info, nil, nil, 1, name, ARDOUR.PresentationInfo.max_order,
                         ARDOUR.TrackMode.Normal, true)
end

local function processor_of(session, track)
  for route in session:get_routes():iter() do
    if route:name() == track then
      local processor = route:the_instrument()
      assert(not processor:isnil(), track .. " has no instrument")
      return processor, processor:to_insert():plugin(0)
    end
  end
  error("there is no track " .. track)
end

local function load_preset(session, track, label)
  local _, plugin = processor_of(session, track)
  local preset = plugin:preset_by_label(label)
  assert(preset and preset.valid and plugin:load_preset(preset), "there is no preset " .. label)
  sleep(0.5)
end

local function set_value(session, track, label, value)
  local processor, plugin = processor_of(session, track)
  local _, number = find_control(plugin, label)
  assert(ARDOUR.LuaAPI.set_processor_param(processor, number, value), "cannot set " .. label)
end

local function add_lane(session, track, label, points)
  local processor, plugin = processor_of(session, track)
  local port, number = find_control(plugin, label)
  local list, lane = ARDOUR.LuaAPI.plugin_automation(processor, number)
  assert(not list:isnil(), label .. " cannot be automated")
  lane:clear_list()
  for time_s, value in points:gmatch("([%d.]+):([%-%d.e]+)") do
    lane:add(Temporal.timepos_t(math.floor(tonumber(time_s) * RATE)), tonumber(value), false, true)
  end
  automation_of(processor, port):set_automation_state(ARDOUR.AutoState.Play)
end

-- The words in the order in which they have to be obeyed
local function obey(session, pattern, call)
  for i = 3, #arg do
    local a, b, c = arg[i]:match(pattern)
    if a then call(session, a, b, c) end
  end
end

local function make()
  local session = create_session(directory, NAME, RATE)
  assert(session, "cannot make a session")
  sleep(0.5)
  obey(session, "^(%w+)=(.*)$", add_track)
  obey(session, "^(%w+)%.preset=(.*)$", load_preset)
  obey(session, "^(%w+):([^=]+)=(.*)$", function(s, track, label, value) set_value(s, track, label, tonumber(value)) end)
  obey(session, "^(%w+)@([^=]+)=(.*)$", add_lane)
  sleep(0.5)
  tell(session)
  return session, true
end

local function check()
  local session = load_session(directory, NAME)
  assert(session, "cannot load the session")
  tell(session)
  return session, true
end

-- A meter's value, by the label of its port
local function read(processor, label)
  local _, number = find_control(processor:to_insert():plugin(0), label)
  return ARDOUR.LuaAPI.get_processor_param(processor, number, false)
end

local function wait_for(what, is_so)
  for _ = 1, WAIT_S / STEP_S do
    if is_so() then return end
    sleep(STEP_S)
  end
  error("waited in vain: " .. what)
end

local function wait_for_sound(processor)
  wait_for("a note", function() return read(processor, METER) > 0 end)
end

local function wait_for_silence(processor, after)
  wait_for("silence after " .. after, function() return read(processor, METER) == 0 end)
end

local function roll_from(session, time_s)
  local frame = math.floor(time_s * RATE)
  session:request_locate(frame, false, ARDOUR.LocateTransportDisposition.MustRoll, BY_USER)
end

local function stop(session)
  session:request_stop(false, false, BY_USER)
  wait_for("the transport to stop", function() return session:transport_stopped() end)
end

-- Each of them begins in the middle of a note and must end in silence.
local gestures = {
  { "stop", function(session) stop(session) end },
  { "locate", function(session, start_s) roll_from(session, start_s + REST_S) end },
  { "bypass", function(_, _, processor)
    local _, number = find_control(processor:to_insert():plugin(0), "Enabled")
    ARDOUR.LuaAPI.set_processor_param(processor, number, 0)
    wait_for_silence(processor, "bypass")
    ARDOUR.LuaAPI.set_processor_param(processor, number, 1)
  end },
  { "deactivate", function(_, _, processor)
    processor:deactivate()
    sleep(STEP_S)
    processor:activate()
  end },
}

-- Silence that comes with the note's own end says nothing; on a busy machine that may happen, but not each time.
local function is_silenced(session, start_s, processor, gesture)
  roll_from(session, start_s)
  wait_for_sound(processor)
  gesture[2](session, start_s, processor)
  wait_for_silence(processor, gesture[1])
  local is_before_end = session:transport_sample() < (start_s + NOTE_END_S) * RATE
  stop(session)
  return is_before_end or gesture[1] == "locate"
end

local function live()
  local session = load_session(directory, NAME)
  assert(session, "cannot load the session")
  obey(session, "^(%w+)@([%d.]+)$", function(_, track, start_s)
    local processor = processor_of(session, track)
    for _, gesture in ipairs(gestures) do
      local tries = 1
      while not is_silenced(session, tonumber(start_s), processor, gesture) do
        assert(tries < 5, track .. " sounds until its note ends, in spite of " .. gesture[1])
        tries = tries + 1
      end
      say("DID", track, gesture[1])
    end
  end)
  return session, false
end

local modes = { make = make, check = check, live = live }
local is_done, what, is_to_save = pcall(modes[mode])
if is_done then
  if is_to_save then what:save_state("", false, false, false, false, false) end
  say("DONE", mode)
  close_session()
else
  say("FAILED", what)
end
quit()
