use super::*;
use proptest::prelude::*;
use rosc::{OscBundle, OscPacket, OscTime, OscType};
use strut_core::humanoid::{JOINTS, Pose, Proportions, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::exp_map::exp;
use strut_core::math::{Quat, Vec3};
use strut_core::retarget::BetweenBodies;

fn rotation() -> impl Strategy<Value = Quat> {
    prop::array::uniform3(-1.7f32..1.7).prop_map(|v| exp(Vec3::from_array(v)))
}

fn place() -> impl Strategy<Value = Place> {
    (prop::array::uniform3(-5.0f32..5.0), rotation())
        .prop_map(|(position, rotation)| Place { position: Vec3::from_array(position), rotation })
}

fn pose() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-3.0f32..3.0), prop::collection::vec(rotation(), JOINTS)).prop_map(|(root, rotations)| {
        let mut pose = Pose { root: Vec3::from_array(root), ..Pose::default() };
        pose.rotations.copy_from_slice(&rotations);
        pose
    })
}

fn message() -> impl Strategy<Value = Message> {
    let other = || OscMessage { addr: "/VMC/Ext/Blend/Val".into(), args: vec!["Joy".into(), 0.5_f32.into()] };
    prop_oneof![
        (0..BONES, place()).prop_map(|(i, place)| Message::Bone(Bone::all().nth(i).unwrap(), place)),
        (place(), prop::option::of(prop::array::uniform6(-2.0f32..2.0)))
            .prop_map(|(place, scale_and_offset)| Message::Root(RootPlace { place, scale_and_offset })),
        (0.0f32..1e5).prop_map(|secs| Message::Time(secs.into())),
        any::<bool>().prop_map(Message::Loaded),
        (-10.0f32..10.0).prop_map(|weight| Message::Style("proud".into(), weight)),
        Just(()).prop_map(move |()| Message::Other(other())),
    ]
}

fn assert_near(a: &Message, b: &Message) {
    match (a, b) {
        (Message::Bone(x, a), Message::Bone(y, b)) => {
            assert_eq!(x, y);
            assert!(a.position == b.position && a.rotation.inv_mul(b.rotation).angle() < 1e-3);
        }
        (Message::Root(a), Message::Root(b)) => {
            assert!(a.scale_and_offset == b.scale_and_offset && a.place.position == b.place.position);
        }
        _ => assert_eq!(a, b),
    }
}

proptest! {
    #[test]
    fn messages_round_trip_in_small_packets(messages in prop::collection::vec(message(), 0..60)) {
        let mut back = Vec::new();
        for packet in encode(&messages) {
            prop_assert!(packet.len() <= PACKET_BYTES);
            prop_assert_eq!(decode(&packet, &mut back), Ok(0));
        }
        prop_assert_eq!(back.len(), messages.len());
        messages.iter().zip(&back).for_each(|(a, b)| assert_near(a, b));
    }

    #[test]
    fn poses_round_trip_through_the_bones_of_any_rest_pose(
        poses in prop::collection::vec(pose(), 3),
        rest in prop::collection::vec(rotation(), BONES),
        root in place(),
        has_upper_chest in any::<bool>(),
        facing in -3.0f32..3.0,
    ) {
        // A sender whose bones have arbitrary rotations in the T-pose.
        let mut theirs = Performer::of_body(&Proportions::default());
        theirs.rest.copy_from_slice(&rest);
        if has_upper_chest {
            theirs.has[Bone::UpperChest.index()] = true;
        }
        let like = Frame { root: RootPlace { place: root, scale_and_offset: None }, bones: offsets_in(&theirs), ..Frame::default() };
        let mut t_pose = Pose::default();
        t_pose.rotations[0] = Quat::from_rotation_y(facing);
        let mut calibration = Calibration::default();
        (0..10).for_each(|_| calibration.push(&theirs.frame(&t_pose, &like)));
        let performer = Performer::new(&theirs.frame(&t_pose, &like), Some(&calibration));
        for (ours, default) in performer.proportions().offsets.iter().zip(&Proportions::default().offsets) {
            prop_assert!(ours.distance(*default) < 2e-3, "{ours} {default}");
        }
        for pose in &poses {
            let frame = theirs.frame(pose, &like);
            let back = performer.pose(&frame);
            prop_assert!(back.root.distance(pose.root) < 1e-4);
            for (a, b) in back.rotations.iter().zip(&pose.rotations) {
                prop_assert!(a.inv_mul(*b).angle() < 3e-3, "{a:?} {b:?}");
            }
            let again = performer.frame(&back, &frame);
            for (a, b) in again.bones.iter().zip(&frame.bones) {
                let (Some(a), Some(b)) = (a, b) else { prop_assert_eq!(a.is_some(), b.is_some()); continue };
                prop_assert!(a.position.distance(b.position) < 1e-3 && a.rotation.inv_mul(b.rotation).angle() < 5e-3);
            }
        }
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let mut messages = Vec::new();
        let _ = decode(&bytes, &mut messages);
    }
}

/// Bones of a body relative to their parents in the T-pose, with a rest rotation each.
fn offsets_in(performer: &Performer) -> [Option<Place>; BONES] {
    let mut bones = [None; BONES];
    for bone in Bone::all().filter(|bone| performer.has[bone.index()]) {
        let parent =
            bone.parent().filter(|parent| performer.has[parent.index()]).or(bone.parent().and_then(Bone::parent));
        let turned = parent.map_or(Quat::IDENTITY, |parent| performer.rest[parent.index()]);
        let offset = match bone {
            // It is at the position of the chest: the neck's offset is relative to it.
            Bone::UpperChest => Vec3::ZERO,
            Bone::Of(role) => performer.proportions().offsets[role.index()],
        };
        bones[bone.index()] = Some(Place { position: turned.inv_mul_vec3(offset), rotation: Quat::IDENTITY });
    }
    bones
}

/// Packets of a sender for a frame of a walk.
fn packets() -> Vec<Vec<u8>> {
    let body = Performer::of_body(&Proportions::default());
    let mut messages: Vec<Message> = body.frame(&Pose::default(), &Frame::default()).messages().collect();
    messages.extend([Message::Loaded(true), Message::Time(1.5), Message::Style("old".into(), 0.5)]);
    messages.push(Message::Other(OscMessage {
        addr: "/x".into(),
        args: vec![
            OscType::Array([OscType::Blob(vec![1, 2, 3]), OscType::Nil].into_iter().collect()),
            OscType::Double(1.0),
        ],
    }));
    encode(&messages)
}

/// Changes bytes, lengths and order of packets. For more cases: `STRUT_MUTATIONS=1000000`.
#[test]
fn mutated_packets_never_panic() {
    let cases = std::env::var("STRUT_MUTATIONS").ok().and_then(|cases| cases.parse().ok()).unwrap_or(20_000);
    let originals = packets();
    let mut state = 1_u64;
    let mut random = move |below: usize| {
        // xorshift64
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below.max(1) as u64) as usize
    };
    let mut messages = Vec::new();
    let mut frames = FrameReader::default();
    let mut secs = 0.0;
    for case in 0..cases {
        let mut packet = originals[case % originals.len()].clone();
        for _ in 0..=random(6) {
            let length = packet.len();
            let at = random(length);
            match random(5) {
                0 => packet.truncate(at),
                1 => packet[at..].rotate_left(4.min(length - at)),
                2 => packet.splice(at..at, [0, 0, 0, random(256) as u8]).for_each(drop),
                _ => packet.get_mut(at).into_iter().for_each(|byte| *byte = random(256) as u8),
            }
        }
        messages.clear();
        let _ = decode(&packet, &mut messages);
        secs += 0.001;
        for message in &messages {
            if let Some(frame) = frames.push(message, secs) {
                let performer = Performer::new(&frame, None);
                assert!(performer.pose(&frame).is_finite() && performer.proportions().is_valid());
            }
        }
    }
}

#[test]
fn what_nests_deeply_or_holds_too_much_is_dropped_before_it_is_read() {
    let bundle = |content: Vec<OscPacket>| {
        OscPacket::Bundle(OscBundle { timetag: OscTime { seconds: 0, fractional: 1 }, content })
    };
    let message = || OscPacket::Message(OscMessage { addr: "/VMC/Ext/T".into(), args: vec![OscType::Float(1.0)] });
    let read = |packet: &OscPacket| decode(&rosc::encoder::encode(packet).unwrap(), &mut Vec::new());
    let nested = |depth: usize| (0..depth).fold(message(), |inside, _| bundle(vec![inside]));
    assert_eq!(read(&nested(MAX_NESTING)), Ok(0));
    assert_eq!(read(&nested(MAX_NESTING + 1)), Err(PacketError::TooDeep));
    assert_eq!(read(&bundle((0..=MAX_MESSAGES).map(|_| message()).collect())), Err(PacketError::TooMany));
    // Bundles nested to the last byte, and arrays: the decoder alone would recurse thousands of times.
    let mut deep = Vec::new();
    for left in (0..3_000_u32).rev() {
        deep.extend(b"#bundle\0\0\0\0\0\0\0\0\x01");
        deep.extend((left * 20).to_be_bytes());
    }
    assert_eq!(decode(&deep, &mut Vec::new()), Err(PacketError::TooDeep));
    for padding in [&b"/a\0\0"[..], b"/\0x\0", b"/\0\0\0"] {
        let mut arrays = padding.to_vec();
        arrays.push(b',');
        arrays.resize(arrays.len() + 60_000, b'[');
        arrays.resize(arrays.len() + 4_000, b']');
        arrays.extend([0; 3]);
        assert_eq!(decode(&arrays, &mut Vec::new()), Err(PacketError::TooDeep));
    }
    assert_eq!(decode(&vec![0; MAX_PACKET_BYTES + 1], &mut Vec::new()), Err(PacketError::TooLarge));
    assert_eq!(decode(b"hello", &mut Vec::new()), Err(PacketError::NotOsc));
}

#[test]
fn messages_with_other_arguments_are_dropped_and_unknown_ones_passed_on() {
    let read = |addr: &str, args: Vec<OscType>| {
        let packet = rosc::encoder::encode(&OscPacket::Message(OscMessage { addr: addr.into(), args })).unwrap();
        let mut messages = Vec::new();
        let dropped = decode(&packet, &mut messages).unwrap();
        (dropped, messages.pop())
    };
    let bone = |name: &str, numbers: &[f32]| {
        let args = std::iter::once(name.into()).chain(numbers.iter().map(|&n| n.into())).collect();
        read("/VMC/Ext/Bone/Pos", args)
    };
    let unit = [0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0];
    // Unity's left-handed axes: x changes its sign.
    let expected = Place { position: Vec3::new(-0.1, 0.2, 0.3), rotation: Quat::IDENTITY };
    assert_eq!(bone("LeftUpperArm", &unit), (0, Some(Message::Bone(Bone::Of(Role::LeftUpperArm), expected))));
    let turned = bone("Head", &[0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.8]).1;
    let Some(Message::Bone(_, place)) = turned else { panic!("{turned:?}") };
    assert!((place.rotation * Vec3::Z).x < -0.9, "a turn to +X, the right, is one to −X here");
    let more = [&unit[..], &[5.0]].concat();
    assert!(matches!(bone("UpperChest", &more), (0, Some(Message::Bone(Bone::UpperChest, _)))));
    assert!(matches!(bone("LeftThumbProximal", &unit), (0, Some(Message::Other(_)))));
    let broken: [&[f32]; 5] = [
        &unit[..6],
        &[f32::NAN, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.4],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.1],
        &[1e9, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    ];
    for numbers in broken {
        assert_eq!(bone("Hips", numbers), (1, None), "{numbers:?}");
    }
    assert_eq!(read("/VMC/Ext/T", vec!["1".into()]), (1, None));
    assert_eq!(read("/VMC/Ext/OK", vec![OscType::Int(1), OscType::Int(3)]), (0, Some(Message::Loaded(true))));
    assert_eq!(read("/strut/style", vec!["old".into(), 11.0_f32.into()]), (1, None));
    assert!(matches!(read("/VMC/Ext/Blend/Apply", vec![]), (0, Some(Message::Other(_)))));
}

/// Bytes of a message with the text of its types and the bytes of its arguments.
fn raw(addr: &str, types: &str, args: &[u8]) -> Vec<u8> {
    let text = |text: &str| {
        let mut bytes = text.as_bytes().to_vec();
        bytes.resize((bytes.len() + 1).next_multiple_of(4), 0);
        bytes
    };
    [text(addr), text(types), args.to_vec()].concat()
}

#[test]
fn numbers_may_be_of_any_type() {
    let read = |addr: &str, args: Vec<OscType>| {
        let packet = rosc::encoder::encode(&OscPacket::Message(OscMessage { addr: addr.into(), args })).unwrap();
        let mut messages = Vec::new();
        assert_eq!(decode(&packet, &mut messages), Ok(0));
        messages.pop()
    };
    let args = |numbers: [OscType; 7]| std::iter::once("Hips".into()).chain(numbers).collect::<Vec<_>>();
    let mixed = args([
        OscType::Double(0.5),
        OscType::Int(1),
        OscType::Long(-2),
        OscType::Nil,
        OscType::Bool(false),
        OscType::Float(0.0),
        OscType::Bool(true),
    ]);
    let expected = Place { position: Vec3::new(-0.5, 1.0, -2.0), rotation: Quat::IDENTITY };
    assert_eq!(read("/VMC/Ext/Bone/Pos", mixed.clone()), Some(Message::Bone(Bone::Of(Role::Hips), expected)));
    let root = RootPlace { place: expected, scale_and_offset: None };
    assert_eq!(read("/VMC/Ext/Root/Pos", mixed), Some(Message::Root(root)));
    // The time of day in seconds: in single precision its resolution would be two minutes.
    let secs = 1_764_393_600.25;
    assert_eq!(read("/VMC/Ext/T", vec![OscType::Double(secs)]), Some(Message::Time(secs)));
    assert_eq!(read("/VMC/Ext/T", vec![OscType::Int(7)]), Some(Message::Time(7.0)));
    assert_eq!(read("/VMC/Ext/T", vec![OscType::Long(1 << 40)]), Some(Message::Time((1_u64 << 40) as f64)));
    for (arg, loaded) in [(OscType::Bool(true), true), (OscType::Long(0), false), (OscType::Float(1.0), true)] {
        assert_eq!(read("/VMC/Ext/OK", vec![arg]), Some(Message::Loaded(loaded)));
    }
    let weight = read("/strut/style", vec!["old".into(), OscType::Int(1)]);
    assert_eq!(weight, Some(Message::Style("old".into(), 1.0)));
    // Arguments that are neither text nor number are skipped at any position.
    let others = [OscType::Inf, OscType::Blob(vec![1, 2, 3]), OscType::Char('x'), OscType::Time(OscTime::from((1, 2)))];
    let time = others.into_iter().chain([OscType::Double(2.5)]).collect();
    assert_eq!(read("/VMC/Ext/T", time), Some(Message::Time(2.5)));
    let mut messages = Vec::new();
    let huge = raw("/VMC/Ext/T", ",d", &f64::INFINITY.to_be_bytes());
    assert_eq!((decode(&huge, &mut messages), messages.len()), (Ok(1), 0));
}

#[test]
fn a_message_with_a_type_that_nobody_knows_does_not_hide_the_others_of_its_bundle() {
    let time = raw("/VMC/Ext/T", ",f", &1.5_f32.to_be_bytes());
    let of_symbol = raw("/strut/style", ",Si", &[&b"old\0"[..], &1_i32.to_be_bytes()].concat());
    let broken = [
        raw("/VMC/Ext/T", ",?f", &1.5_f32.to_be_bytes()),
        raw("/VMC/Ext/T", ",d", &1.5_f32.to_be_bytes()),
        raw("/x", ",b", &u32::MAX.to_be_bytes()),
        raw("/x", ",[f", &1.5_f32.to_be_bytes()),
        raw("/x", ",]", &[]),
        raw("x", ",f", &1.5_f32.to_be_bytes()),
        b"/\xff\0\0,\0\0\0".to_vec(),
        b"/x".to_vec(),
    ];
    for broken in &broken {
        let mut bundle = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
        for part in [&of_symbol, broken, &time] {
            bundle.extend((part.len() as u32).to_be_bytes());
            bundle.extend(part);
        }
        let mut messages = Vec::new();
        assert_eq!(decode(&bundle, &mut messages), Ok(1), "{broken:?}");
        assert_eq!(messages, [Message::Style("old".into(), 1.0), Message::Time(1.5)], "{broken:?}");
    }
}

/// Frames that result from messages with these arrival times.
fn frames(arrivals: &[(f64, Message)]) -> Vec<Frame> {
    let mut reader = FrameReader::default();
    let mut frames = Vec::new();
    for (secs, message) in arrivals {
        frames.extend(reader.silence(*secs));
        frames.extend(reader.push(message, *secs));
    }
    frames.extend(reader.silence(1e9));
    frames
}

fn bone_at(role: Role, x: f32) -> Message {
    Message::Bone(Bone::Of(role), Place { position: Vec3::X * x, rotation: Quat::IDENTITY })
}

#[test]
fn a_time_the_next_hips_or_silence_end_a_frame() {
    let (hips, spine) = (|x| bone_at(Role::Hips, x), bone_at(Role::Spine, 0.0));
    let timed: Vec<(f64, Message)> = (0..4)
        .flat_map(|i| [hips(i as f32), spine.clone(), Message::Time(f64::from(i))].map(|m| (f64::from(i) * 0.001, m)))
        .collect();
    let found = frames(&timed);
    // Whether the first frame is complete cannot be known.
    assert_eq!(found.iter().map(|f| f.sent_secs).collect::<Vec<_>>(), [1.0, 2.0, 3.0].map(Some));
    let untimed: Vec<(f64, Message)> = timed.into_iter().filter(|(_, m)| !matches!(m, Message::Time(_))).collect();
    assert_eq!(frames(&untimed).len(), 3);
    let apart: Vec<(f64, Message)> =
        untimed.into_iter().enumerate().map(|(i, (_, m))| ((i / 2) as f64 * 0.005, m)).collect();
    let found = frames(&apart);
    assert_eq!(found.iter().map(|f| f.bones[0].unwrap().position.x).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    assert!(found.iter().all(|f| f.sent_secs.is_none()));
}

#[test]
fn a_root_belongs_to_the_bones_that_come_after_it() {
    let root = |x: f32| {
        let place = Place { position: Vec3::X * x, rotation: Quat::IDENTITY };
        Message::Root(RootPlace { place, scale_and_offset: None })
    };
    for (timed, step_secs) in [(false, 0.001), (false, 0.01), (true, 0.001), (true, 0.01)] {
        let frame = |i: u8| {
            let (x, secs) = (f32::from(i), step_secs * f64::from(i));
            let mut messages = vec![root(x), bone_at(Role::Hips, x), bone_at(Role::Spine, 0.0)];
            if timed {
                messages.push(Message::Time(secs));
            }
            messages.into_iter().map(move |message| (secs, message))
        };
        let found = frames(&(0..5).flat_map(frame).collect::<Vec<_>>());
        let at = |place: Place| place.position.x;
        let places = found.iter().map(|f| (at(f.root.place), at(f.bones[0].unwrap()))).collect::<Vec<_>>();
        assert_eq!(places, [1.0, 2.0, 3.0, 4.0].map(|x| (x, x)), "{timed} {step_secs}");
    }
}

#[test]
fn silence_does_not_cut_the_frames_of_those_who_send_times() {
    let frame = |i: u8| {
        let messages = [bone_at(Role::Hips, 0.0), bone_at(Role::Spine, 0.0), Message::Time(f64::from(i))];
        // The sender is delayed in the middle of the later frames.
        let step = if i < 2 { 0.0 } else { 0.01 };
        messages.into_iter().enumerate().map(move |(n, message)| (f64::from(i) + n as f64 * step, message))
    };
    let arrivals: Vec<_> = (0..6).flat_map(frame).collect();
    assert_eq!(frames(&arrivals).iter().map(|f| f.sent_secs).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0, 5.0].map(Some));
}

#[test]
fn a_frame_without_one_of_its_packets_is_dropped() {
    let frame = |i: u8, with_spine: bool| {
        let mut messages = vec![bone_at(Role::Hips, f32::from(i))];
        if with_spine {
            messages.push(bone_at(Role::Spine, 0.0));
        }
        messages.push(Message::Time(f64::from(i)));
        messages.into_iter().map(move |message| (f64::from(i) * 0.01, message))
    };
    let times = |lacking: &[u8]| {
        let arrivals: Vec<_> = (0..6).flat_map(|i| frame(i, !lacking.contains(&i))).collect();
        frames(&arrivals).iter().map(|f| f.sent_secs.unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(times(&[3]), [1.0, 2.0, 4.0, 5.0]);
    assert_eq!(times(&[0]), [1.0, 2.0, 3.0, 4.0, 5.0]);
    // A bone that is missing once is not sent from then on.
    assert_eq!(times(&[3, 4, 5]), [1.0, 2.0, 4.0, 5.0]);
}

#[test]
fn a_bone_that_is_not_sent_any_more_returns_to_rest_and_follows_at_once_when_it_is() {
    let mut theirs = Performer::of_body(&Proportions::default());
    // Bones with rest rotations, as a calibration determines them.
    theirs.rest = std::array::from_fn(|i| exp(Vec3::new(0.1 * i as f32, 0.5, -0.3)));
    let arm = Role::LeftUpperArm.index();
    let mut pose = Pose { root: Vec3::Y, ..Pose::default() };
    pose.rotations[arm] = Quat::from_rotation_z(-1.2);
    let messages: Vec<Message> = theirs.frame(&pose, &Frame::default()).messages().collect();
    let mut reader = FrameReader::default();
    let mut turns = Vec::new();
    for i in 0..240 {
        let secs = f64::from(i) / 60.0;
        // The arm is sent in the first second, and again from the fourth on; one frame is delayed.
        let is_sent = |message: &Message| match message {
            Message::Bone(bone, _) => *bone != Bone::Of(Role::LeftUpperArm) || !(60..180).contains(&i),
            _ => true,
        };
        for message in messages.iter().filter(|message| is_sent(message)).chain([&Message::Time(secs)]) {
            if let Some(frame) = reader.push(message, secs) {
                let found = theirs.pose(&frame);
                turns.push((i, found.rotations[arm].angle()));
                for (other, expected) in
                    found.rotations.iter().zip(&pose.rotations).enumerate().filter_map(|(i, q)| (i != arm).then_some(q))
                {
                    assert!(other.inv_mul(*expected).angle() < 2e-3);
                }
            }
        }
    }
    let fastest = turns.windows(2).filter(|w| w[1].0 < 180).map(|w| (w[1].1 - w[0].1).abs()).fold(0.0, f32::max);
    assert!(fastest < 0.15, "no leap: {fastest} rad");
    for (i, turn) in turns {
        match i {
            0..119 | 180.. => assert!((turn - 1.2).abs() < 2e-3, "{i}: {turn}"),
            133..180 => assert!(turn < 2e-3, "{i}: {turn}"),
            _ => assert!(turn < 1.21, "{i}: {turn}"),
        }
    }
}

#[test]
fn another_avatar_has_no_bone_of_the_one_before() {
    let child = Proportions { offsets: Proportions::default().offsets.map(|offset| offset * 0.7) };
    let (mut with_upper_chest, without) = (Performer::of_body(&Proportions::default()), Performer::of_body(&child));
    with_upper_chest.has[Bone::UpperChest.index()] = true;
    let mut like = Frame { bones: offsets_in(&with_upper_chest), ..Frame::default() };
    like.bones[Bone::UpperChest.index()] = Some(Place { position: Vec3::Y * 0.2, rotation: Quat::IDENTITY });
    let mut pose = Pose { root: Vec3::Y, ..Pose::default() };
    pose.rotations[Role::Chest.index()] = Quat::from_rotation_y(0.9);
    let send = |reader: &mut FrameReader, by: &Performer, pose: &Pose, like: &Frame, secs: f64| {
        let messages: Vec<Message> = by.frame(pose, like).messages().chain([Message::Time(secs)]).collect();
        messages.iter().filter_map(|message| reader.push(message, secs)).last()
    };
    let mut reader = FrameReader::default();
    let first = (0..3).filter_map(|i| send(&mut reader, &with_upper_chest, &pose, &like, 0.01 * f64::from(i))).last();
    let bodies = Performer::new(&first.unwrap(), None);
    // The next avatar looks straight ahead, and has no upper chest.
    let straight = Pose { root: Vec3::Y * 0.7, ..Pose::default() };
    let next = (3..6).filter_map(|i| send(&mut reader, &without, &straight, &Frame::default(), 0.01 * f64::from(i)));
    let next = next.last().unwrap();
    assert!(!bodies.has_body_of(&next));
    let body = Performer::new(&next, None);
    for (found, expected) in body.proportions().offsets.iter().zip(&child.offsets) {
        assert!(found.distance(*expected) < 2e-3, "{found} {expected}");
    }
    for turn in body.pose(&next).rotations {
        assert!(turn.angle() < 2e-3, "{turn:?}");
    }
    // Back to the first avatar, even in the size of the other: it has one more bone.
    let mut small = without.clone();
    small.has = with_upper_chest.has;
    let again = (6..9).filter_map(|i| send(&mut reader, &small, &straight, &Frame::default(), 0.01 * f64::from(i)));
    assert!(!body.has_body_of(&again.last().unwrap()));
    // A body with a bone that is not sent for a while is the same body.
    let mut lacking = next;
    lacking.held[Role::LeftHand.index()] = true;
    assert!(body.has_body_of(&lacking) && body.has_body_of(&next));
}

#[test]
fn a_sender_without_a_model_is_not_heard() {
    let arrivals = (0..8_u8).flat_map(|i| {
        [Message::Loaded(i < 4), bone_at(Role::Hips, 0.0), Message::Time(f64::from(i))].map(|m| (f64::from(i), m))
    });
    assert_eq!(frames(&arrivals.collect::<Vec<_>>()).len(), 3);
}

#[test]
fn bodies_come_from_offsets_or_the_height_of_the_hips() {
    let mut body = Proportions::default();
    body.offsets.iter_mut().for_each(|offset| *offset *= 0.8);
    let sender = Performer::of_body(&body);
    let frame = sender.frame(&Pose { root: body.offsets[0], ..Pose::default() }, &Frame::default());
    let found = Performer::new(&frame, None);
    for (a, b) in found.proportions().offsets.iter().zip(&body.offsets) {
        assert!(a.distance(*b) < 2e-3, "{a} {b}");
    }
    let mut without = frame;
    for (i, bone) in without.bones.iter_mut().enumerate().skip(1) {
        *bone = (i < Role::ALL.len()).then_some(Place::default());
    }
    let found = Performer::new(&without, None);
    assert!((found.proportions().leg_length() / body.leg_length() - 1.0).abs() < 1e-3);
    without.bones[0] = Some(Place { position: Vec3::Y * -5.0, rotation: Quat::IDENTITY });
    assert_eq!(Performer::new(&without, None).proportions(), &Proportions::default());
}

#[test]
fn hips_are_relative_to_where_the_model_stands() {
    let performer = Performer::of_body(&Proportions::default());
    let mut pose = Pose { root: Vec3::new(2.0, 0.9, 1.0), ..Pose::default() };
    pose.rotations[0] = Quat::from_rotation_y(0.5);
    let stands = Place { position: Vec3::new(1.0, 0.0, -1.0), rotation: Quat::from_rotation_y(1.2) };
    let like = Frame { root: RootPlace { place: stands, scale_and_offset: None }, ..Frame::default() };
    let frame = performer.frame(&pose, &like);
    assert_eq!(frame.root.place, stands);
    let back = performer.pose(&frame);
    assert!(back.root.distance(pose.root) < 1e-5);
    assert!(back.rotations[0].inv_mul(pose.rotations[0]).angle() < 1e-3);
    let (there, here) = (frame.world(), world_from_local(performer.proportions(), &pose));
    for role in Role::ALL {
        assert!(there[role.index()].position.distance(here.positions[role.index()]) < 1e-5, "{role:?}");
    }
}

#[test]
fn a_body_of_another_size_is_led_there_and_back() {
    let mut other = Proportions::default();
    other.offsets.iter_mut().for_each(|offset| *offset *= 1.15);
    let (there, back) =
        (BetweenBodies::new(&Proportions::default(), &other), BetweenBodies::new(&other, &Proportions::default()));
    let mut pose = Pose { root: Vec3::new(0.3, 0.9, 0.1), ..Pose::default() };
    for (role, angle) in [(Role::LeftUpperLeg, -0.5), (Role::LeftLowerLeg, 0.8), (Role::RightLowerLeg, 0.2)] {
        pose.rotations[role.index()] = Quat::from_rotation_x(angle);
    }
    let again = back.pose(&there.pose(&pose));
    assert!(again.root.distance(pose.root) < 1e-4);
    for (a, b) in again.rotations.iter().zip(&pose.rotations) {
        assert!(a.inv_mul(*b).angle() < 2e-3, "{a:?} {b:?}");
    }
}
