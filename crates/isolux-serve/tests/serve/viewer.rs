//! A client that watches events.

use crate::client::connect;
use std::io::{BufRead, BufReader, Write};
use std::net::{SocketAddr, TcpStream};

/// An event as it came.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Event {
    pub(crate) name: String,
    pub(crate) id: String,
    pub(crate) data: String,
    pub(crate) comment: String,
}

pub(crate) struct Viewer(BufReader<TcpStream>);

impl Viewer {
    /// One whose stream has begun. HTTP/1.0 has no chunks between the lines.
    pub(crate) fn join(address: SocketAddr) -> Self {
        let mut stream = connect(address);
        let request = format!("GET /api/events HTTP/1.0\r\nHost: {address}\r\n\r\n");
        stream.write_all(request.as_bytes()).unwrap();
        let mut viewer = Self(BufReader::new(stream));
        assert!(viewer.line().unwrap().contains(" 200 "));
        while viewer.line().unwrap() != "" {}
        viewer
    }

    /// The next line; `None` at the end of the stream.
    fn line(&mut self) -> Option<String> {
        let mut line = String::new();
        let length = self.0.read_line(&mut line).unwrap();
        (length > 0).then(|| line.trim_end_matches(['\r', '\n']).to_owned())
    }

    /// The next event; `None` at the end of the stream.
    pub(crate) fn next(&mut self) -> Option<Event> {
        let mut event = Event::default();
        loop {
            let line = self.line()?;
            if line.is_empty() {
                return Some(event);
            }
            let (field, value) = line.split_once(':').unwrap();
            let value = value.strip_prefix(' ').unwrap_or(value).to_owned();
            match field {
                "event" => event.name = value,
                "id" => event.id = value,
                "data" => event.data = value,
                "retry" => assert_eq!(value, "1000"),
                "" => event.comment = value,
                other => panic!("field {other}"),
            }
        }
    }

    /// The data of the next event, which has a certain name.
    pub(crate) fn data(&mut self, name: &str) -> String {
        let event = self.next().unwrap();
        assert_eq!(event.name, name);
        event.data
    }
}
